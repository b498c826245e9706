// SPDX-License-Identifier: Apache-2.0
// A part of a saved map is that part of the whole one, and only its tiles are read.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include "equivalence/random_scans.hpp"
#include "evigrid/io.hpp"
#include "temp_folder.hpp"

namespace evigrid {
namespace {

std::string bytes_of(const Map& map) {
  std::ostringstream out;
  save(map, out);
  return out.str();
}
std::span<const std::byte> view(const std::string& s) { return std::as_bytes(std::span(s)); }

Map driven(const testing::Drive& drive, const MapParams& params) {
  Map map(params, make_serial_executor());
  for (const Sensor& s : drive.sensors) map.add(s);
  map.integrate(drive.scans);
  return map;
}

CellRect random_rect(const CellRect& around, std::mt19937& rng) {
  const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(rng() % static_cast<std::uint32_t>(n)); };
  return {around.x - 10 + below(around.width + 20), around.y - 10 + below(around.height + 20),
          1 + below(around.width / 2), 1 + below(around.height / 2)};
}

/// Outside of the rectangle cleared by the map's own means.
Map cut(const std::string& bytes, const CellRect& r) {
  Map map = load(view(bytes));
  constexpr std::int64_t kFar = 1 << 20;
  map.clear({-kFar, -kFar, 2 * kFar, r.y + kFar});
  map.clear({-kFar, r.y + r.height, 2 * kFar, kFar - r.y - r.height});
  map.clear({-kFar, -kFar, r.x + kFar, 2 * kFar});
  map.clear({r.x + r.width, -kFar, kFar - r.x - r.width, 2 * kFar});
  return map;
}

TEST(PartOfASavedMap, IsThatPartOfTheWhole) {
  const auto d = testing::drive(Model::li2014, 30, 5);
  std::mt19937 rng(7);
  for (const MapParams& params :
       {MapParams{.keep_con = true}, MapParams{.rule = Rule::cautious}, MapParams{.decay_s = 5}}) {
    const std::string bytes = bytes_of(driven(*d, params));
    const CellRect all = load(view(bytes)).bounds();
    for (int i = 0; i < 20; ++i) {
      const CellRect r = random_rect(all, rng);
      Map part = load(view(bytes), {.region = r}), wanted = cut(bytes, r);
      ASSERT_EQ(part.hash(), wanted.hash());
      ASSERT_EQ(part.tiles(), wanted.tiles());
      ASSERT_EQ(part.bounds(), wanted.bounds());
      for (const Layer layer : {Layer::conflict, Layer::con}) {
        std::vector<float> a(static_cast<std::size_t>(r.width * r.height)), b(a);
        part.render(layer, r, a, r.width);
        wanted.render(layer, r, b, r.width);
        ASSERT_EQ(a, b);
      }
      part.integrate(d->scans);  // goes on fusing, at the last stamp of the whole
      wanted.integrate(d->scans);
      ASSERT_EQ(part.hash(), wanted.hash());
    }
  }
}

TEST(PartOfASavedMap, OnlyItsTilesAreRead) {
  const TempFolder folder;
  const auto d = testing::drive(Model::li2014, 40, 5);
  const std::string bytes = bytes_of(driven(*d, {.cell_m = 0.02}));
  const std::string file = folder.write("m.evigrid", bytes);
  std::uint64_t whole = 0, part = 0, none = 0;
  const Map all = load(file, {.bytes_read = &whole});
  ASSERT_GT(all.tiles(), 50U);
  EXPECT_EQ(whole, bytes.size() + 8);  // the magic is looked at twice
  const CellRect b = all.bounds();
  (void)load(file, {.region = CellRect{b.x + b.width, b.y + b.height, 5, 5}, .bytes_read = &none});
  const CellIndex middle{b.x + b.width / 2, b.y + b.height / 2};
  const Map one = load(file, {.region = CellRect{middle.x & -64, middle.y & -64, 64, 64}, .bytes_read = &part});
  ASSERT_EQ(one.tiles(), 1U);
  EXPECT_GT(part, none);
  EXPECT_LE(part, none + 64 * 64 * 16);  // one tile, compressed
  EXPECT_LT(part, whole / 10);
}

TEST(PartOfASavedMap, TheCapIsHeldAgainstThePart) {
  const auto d = testing::drive(Model::li2014, 40, 5);
  const std::string bytes = bytes_of(driven(*d, {.cell_m = 0.02}));
  const std::size_t cap = 3 * 64 * 64 * 16;
  EXPECT_THROW((void)load(view(bytes), {.memory_cap_bytes = cap}), MapFileError);
  const CellRect b = load(view(bytes)).bounds();
  const CellRect small{(b.x + b.width / 2) & -64, (b.y + b.height / 2) & -64, 64, 64};
  EXPECT_EQ(load(view(bytes), {.memory_cap_bytes = cap, .region = small}).tiles(), 1U);
  EXPECT_THROW((void)load(view(bytes), {.memory_cap_bytes = cap, .region = b}), MapFileError);
}

TEST(PartOfASavedMap, AnyRectangleIsARectangle) {
  const auto d = testing::drive(Model::hughes1992, 10, 2);
  const Map whole = driven(*d, {});
  const std::string bytes = bytes_of(whole);
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min(),
                         kMost = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(load(view(bytes), {.region = CellRect{}}).tiles(), 0U);
  EXPECT_EQ(load(view(bytes), {.region = CellRect{5, 5, -3, 3}}).tiles(), 0U);
  EXPECT_EQ(load(view(bytes), {.region = CellRect{kMost, kMost, kMost, kMost}}).tiles(), 0U);
  EXPECT_EQ(load(view(bytes), {.region = CellRect{kLeast, kLeast, kMost, kMost}}).bounds(),
            cut(bytes, {-(1 << 20), -(1 << 20), (1 << 20) - 1, (1 << 20) - 1}).bounds());
  EXPECT_EQ(load(view(bytes), {.region = CellRect{-(kMost / 2), -(kMost / 2), kMost, kMost}}).hash(), whole.hash());
}

TEST(PartOfASavedMap, DamageIsSeenWhereItIsRead) {
  const auto d = testing::drive(Model::li2014, 20, 5);
  std::string bytes = bytes_of(driven(*d, {}));
  const CellRect b = load(view(bytes)).bounds();
  bytes[bytes.find("\x28\xB5\x2F\xFD") + 20] ^= 1;  // inside the first tile: the lowest row
  EXPECT_THROW((void)load(view(bytes)), MapFileError);
  EXPECT_THROW((void)load(view(bytes), {.region = b}), MapFileError);
  EXPECT_NO_THROW((void)load(view(bytes), {.region = CellRect{b.x, b.y + 64, b.width, b.height}}));
}

TEST(PartOfASavedMap, AtTheEndOfWhatAMapMayHave) {
  Map map({.rule = Rule::dempster}, make_serial_executor());
  const std::vector<Mass> wall{{0, 0.9f, 0.1f}};
  const std::int64_t far = std::int64_t{1} << 60;
  map.write({far, 0, 1, 1}, wall, 1);
  const std::string bytes = bytes_of(map);
  const Map part = load(view(bytes), {.region = CellRect{far, 0, 1, 1}});
  EXPECT_EQ(part.hash(), map.hash());
}

}  // namespace
}  // namespace evigrid
