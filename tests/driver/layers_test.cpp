// SPDX-License-Identifier: Apache-2.0
// masses.npy, map.pgm and map.yaml, byte for byte where other programs read them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "error.hpp"
#include "out/costmap.hpp"
#include "out/layers.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

/// 3 wide, 2 high: row 0 (smallest y) empty, occupied, unknown; row 1 all undecided.
Layers small() {
  Layers l;
  l.rect = {-4, 2, 3, 2};
  l.cell_m = 0.5;
  l.planes = {0.9F,      0,    0, 0, 0,     0.5F, /**/ 0, 0.9F, 0, 0, 0.25F, 0.5F,
              /**/ 0.1F, 0.1F, 1, 1, 0.75F, 0,    /**/ 0, 0,    0, 0, 0,     2};
  return l;
}

TEST(Npy, HeadIsVersionOneAlignedAndTells) {
  const std::string head = npy_head(small());
  EXPECT_EQ(head.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(head.size() % 64, 0u);
  EXPECT_EQ(static_cast<unsigned char>(head[8]) + 256u * static_cast<unsigned char>(head[9]), head.size() - 10);
  EXPECT_EQ(head.back(), '\n');
  EXPECT_TRUE(contains(head, "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 2, 3), }"));
}

TEST(Pgm, TrinaryWithTheLargestYOnTop) {
  const std::string image = pgm(small());
  ASSERT_TRUE(starts_with(image, "P5\n"));
  const std::string pixels = image.substr(image.size() - 6);
  const std::string wanted{static_cast<char>(205), static_cast<char>(205), static_cast<char>(205),
                           static_cast<char>(254), static_cast<char>(0),   static_cast<char>(205)};
  EXPECT_EQ(pixels, wanted);
  EXPECT_TRUE(contains(image, "\n3 2\n255\n"));
}

std::vector<int> pixels_of(const std::string& image, std::size_t n) {
  std::vector<int> out;
  for (const char c : image.substr(image.size() - n)) out.push_back(static_cast<unsigned char>(c));
  return out;
}

TEST(Pgm, ScaleIsWhatMapServerTurnsBackIntoBetP) {
  const Layers l = small();
  const std::vector<int> pixels = pixels_of(pgm(l, PgmMode::scale), 6);
  EXPECT_EQ(pixels, (std::vector<int>{128, 96, 128, 242, 13, 128}));  // BetP .5 .625 .5 / .05 .95 .5
  for (std::size_t i = 0; i < 6; ++i) {                               // the loader: occ = (255 - pixel) / 255
    const std::size_t cell = i < 3 ? i + 3 : i - 3;
    EXPECT_NEAR((255 - pixels[i]) / 255.0, l.o()[cell] + 0.5 * l.u()[cell], 0.5 / 255 + 1e-6);
  }
  EXPECT_TRUE(contains(map_yaml(l, "m.pgm", PgmMode::scale), "\nmode: scale\n"));
}

TEST(Pgm, RawIsTheOccupancyItself) {
  EXPECT_EQ(pixels_of(pgm(small(), PgmMode::raw), 6), (std::vector<int>{255, 63, 50, 5, 95, 255}));
  EXPECT_TRUE(contains(map_yaml(small(), "m.pgm", PgmMode::raw), "\nmode: raw\n"));
  EXPECT_EQ(parse_pgm_mode("raw"), PgmMode::raw);
  EXPECT_THROW(parse_pgm_mode("RAW"), InputError);
}

Map seen_map() {
  Map map({.cell_m = 0.1}, make_serial_executor());
  const SensorId id = map.add(Sensor{});
  const float range_m = 2;
  const Reading reading{id, {&range_m, 1}};
  map.integrate(Scan{0, {0.05, 0.05, 0.3}, {&reading, 1}});
  return map;
}

TEST(Costs, ArraysAndImageHoldTheEnginesBytes) {
  const Map map = seen_map();
  const CellRect r = map.bounds();
  const auto n = static_cast<std::size_t>(r.width * r.height);
  const std::string grid = occupancy_npy(map, r), costs = costmap_npy(map, r), image = costmap_pgm(map, r);
  EXPECT_TRUE(contains(
      grid, fmt::format("{{'descr': '|i1', 'fortran_order': False, 'shape': ({}, {}), }}", r.height, r.width)));
  EXPECT_TRUE(contains(costs, "'descr': '|u1'"));
  EXPECT_EQ((grid.size() - n) % 64, 0u);
  const std::vector<int> upright = pixels_of(costs, n), picture = pixels_of(image, n), cells = pixels_of(grid, n);
  for (std::int64_t y = 0; y < r.height; ++y) {
    for (std::int64_t x = 0; x < r.width; ++x) {
      const Mass m = map.mass({r.x + x, r.y + y});
      const auto i = static_cast<std::size_t>(y * r.width + x);
      ASSERT_EQ(upright[i], cost_of({}, m));
      ASSERT_EQ(static_cast<std::int8_t>(cells[i]), occupancy_of({}, m));
      ASSERT_EQ(picture[static_cast<std::size_t>((r.height - 1 - y) * r.width + x)], cost_of({}, m));
    }
  }
}

TEST(Yaml, OriginIsTheLowerLeftCorner) {
  EXPECT_EQ(map_yaml(small(), "map.pgm"),
            "image: map.pgm\nmode: trinary\nresolution: 0.5\norigin: [-2, 1, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(Dense, TooLargeIsRefusedByName) {
  require_dense_fits({0, 0, 1000, 1000}, 20);
  try {
    require_dense_fits({0, 0, 4'000'000'000, 4'000'000'000}, 2048);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "masses.npy"));
    EXPECT_TRUE(contains(error.what(), "--max-image-mb 2048"));
  }
}

TEST(Dense, PlanesAreTheMapsFloats) {
  const Map map = seen_map();
  const Layers l = render_layers(map, 100);
  ASSERT_FALSE(l.rect.empty());
  for (std::int64_t y = 0; y < l.rect.height; ++y) {
    for (std::int64_t x = 0; x < l.rect.width; ++x) {
      const CellIndex cell{l.rect.x + x, l.rect.y + y};
      const auto i = static_cast<std::size_t>(y * l.rect.width + x);
      EXPECT_EQ(map.mass(cell), (Mass{l.e()[i], l.o()[i], l.u()[i]}));
      EXPECT_EQ(map.conflict(cell), l.conflict()[i]);
    }
  }
}

}  // namespace
}  // namespace evigrid::driver
