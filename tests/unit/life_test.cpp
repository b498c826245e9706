// SPDX-License-Identifier: Apache-2.0
// A map over time: areas forgotten, protected, written, a window that rolls. What must be there is read off maps that
// were fused without any of it, cell by cell.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kTileBytes = 64 * 64 * 4 * sizeof(float);

Map new_map(const testing::Drive& d, MapParams params = {.cell_m = 0.05}) {
  Map map(params, make_serial_executor());
  for (const Sensor& s : d.sensors) map.add(s);
  return map;
}
bool inside(const CellRect& r, CellIndex c) {
  return c.x >= r.x && c.x < r.x + r.width && c.y >= r.y && c.y < r.y + r.height;
}
/// The tiles that a rectangle meets, as cells.
CellRect tiles_around(const CellRect& r) {
  const std::int64_t x0 = r.x >> 6, y0 = r.y >> 6, x1 = (r.x + r.width - 1) >> 6, y1 = (r.y + r.height - 1) >> 6;
  return {x0 * 64, y0 * 64, (x1 - x0 + 1) * 64, (y1 - y0 + 1) * 64};
}
/// Every cell of `got` is wanted(c); all of both maps lie in rect.
template <class Wanted>
void expect_cells(const Map& got, const CellRect& rect, Wanted&& wanted) {
  int differ = 0;
  for (std::int64_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (std::int64_t x = rect.x; x < rect.x + rect.width; ++x) {
      const CellIndex c{x, y};
      if (got.mass(c) == wanted(c)) continue;
      if (++differ == 1) ADD_FAILURE() << x << ' ' << y << ": o " << got.mass(c).o << " not " << wanted(c).o;
    }
  }
  EXPECT_EQ(differ, 0);
}

const CellRect kAll{-150, -150, 400, 400};

/// What std::invalid_argument says; empty when nothing is thrown.
template <class F>
std::string message(F&& act) {
  try {
    act();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return {};
}

TEST(Life, ForgettingARectangleLeavesTheRestAndGivesMemoryBack) {
  const auto d = testing::drive(Model::li2014, 20, 3);
  const Map whole = [&] {
    Map m = new_map(*d);
    m.integrate(d->scans);
    return m;
  }();
  for (const CellRect& r : {CellRect{10, -20, 30, 7}, CellRect{-64, -64, 128, 128}, CellRect{-70, -1, 200, 66}}) {
    Map map = new_map(*d);
    map.integrate(d->scans);
    const MapView before = map.view();
    const std::uint64_t version = map.version();
    map.clear(r);
    EXPECT_EQ(map.version(), version + 1);
    expect_cells(map, kAll, [&](CellIndex c) { return inside(r, c) ? Mass{} : whole.mass(c); });
    EXPECT_EQ(map.conflict({12, -18}), inside(r, {12, -18}) ? 0 : whole.conflict({12, -18}));
    EXPECT_EQ(before.hash(), whole.hash());
    // A consumer that draws what is listed sees it.
    const Changes changes = map.changes(version);
    EXPECT_FALSE(changes.cleared);
    for (std::int64_t y = r.y; y < r.y + r.height; ++y) {
      for (std::int64_t x = r.x; x < r.x + r.width; ++x) {
        if (whole.mass({x, y}) == Mass{}) continue;
        ASSERT_TRUE(std::any_of(changes.rects.begin(), changes.rects.end(),
                                [&](const CellRect& one) {
                                  return inside(one, {x, y});
                                }))
            << x << ' ' << y;
      }
    }
    EXPECT_EQ(map.view().changes(version).rects.size(), changes.rects.size());
  }
  Map map = new_map(*d);
  map.integrate(d->scans);
  map.clear(kAll);
  EXPECT_EQ(map.memory_bytes(), 0u);
  EXPECT_EQ(map.hash(), new_map(*d).hash());
  map.integrate(d->scans);
  EXPECT_EQ(map.hash(), whole.hash());
}

TEST(Life, AWindowThatRollsKeepsItsTilesAndNothingElse) {
  const auto d = testing::drive(Model::li2014, 60, 5);
  Map map = new_map(*d), whole = new_map(*d);
  for (const Scan& s : d->scans) whole.integrate(s);
  // Standing: the window's part of the whole map.
  const CellRect w{-30, 5, 90, 50}, tiles = tiles_around(w);
  map.set_window(w);
  for (const Scan& s : d->scans) map.integrate(s);
  expect_cells(map, kAll, [&](CellIndex c) { return inside(tiles, c) ? whole.mass(c) : Mass{}; });
  EXPECT_LE(map.tiles(), static_cast<std::size_t>(tiles.width / 64 * tiles.height / 64));
  // Moving: what left is forgotten, also when the window comes back.
  const CellRect away{70, 5, 90, 50}, left = tiles_around(away);
  std::uint64_t version = map.version();
  map.set_window(away);
  expect_cells(map, kAll, [&](CellIndex c) { return inside(tiles, c) && inside(left, c) ? whole.mass(c) : Mass{}; });
  for (const CellRect& r : map.changes(version).rects) EXPECT_FALSE(inside(left, {r.x, r.y}));
  map.set_window(w);
  expect_cells(map, kAll, [&](CellIndex c) { return inside(tiles, c) && inside(left, c) ? whole.mass(c) : Mass{}; });
  // Cells that were dropped and come back are listed once, whole.
  version = map.version();
  for (const Scan& s : d->scans) map.integrate(s);
  std::map<std::pair<std::int64_t, std::int64_t>, int> listed;
  for (const CellRect& r : map.changes(0).rects) ++listed[{r.x >> 6, r.y >> 6}];
  for (const auto& [tile, n] : listed) EXPECT_EQ(n, 1) << tile.first << ' ' << tile.second;
  map.set_window({});
  map.integrate(d->scans);
  EXPECT_GT(map.bounds().width, tiles.width);
}

TEST(Life, ALongDriveInAWindowNeedsTheMemoryOfTheWindow) {
  const auto d = testing::drive(Model::li2014, 8, 1);
  Map map = new_map(*d);
  std::uint64_t version = 0;
  std::vector<MapView> last;
  for (int i = 0; i < 3000; ++i) {
    const double x = 2.0 * i;
    const auto at = static_cast<std::int64_t>(x / 0.05);
    map.set_window({at - 200, -300, 400, 600});
    Scan s = d->scans[static_cast<std::size_t>(i) % 8];
    s.T_map_robot.x_m += x;
    map.integrate(s);
    ASSERT_LE(map.tiles(), 8u * 11u);
    if (i % 100 == 0) last = {map.view()};
    if (i % 500 == 0) version = map.version();
  }
  last.clear();
  EXPECT_EQ(map.memory_bytes(), map.tiles() * kTileBytes);
  EXPECT_TRUE(map.changes(0).cleared);  // too much was dropped to be listed
  EXPECT_LT(map.changes(version).rects.size(), 5000u);
}

TEST(Life, ProtectedAreasStayAndTheOthersDoNotNotice) {
  const auto d = testing::drive(Model::li2014, 30, 7);
  for (const CellRect& area : {CellRect{0, 0, 64, 64}, CellRect{-40, 3, 77, 41}, CellRect{300, 300, 5, 5}}) {
    Map map = new_map(*d), whole = new_map(*d), half = new_map(*d);
    const auto first = std::span(d->scans).first(15), second = std::span(d->scans).subspan(15);
    map.integrate(first), half.integrate(first), whole.integrate(d->scans);
    map.protect(area);
    map.integrate(second);
    const auto wanted = [&](CellIndex c) { return inside(area, c) ? half.mass(c) : whole.mass(c); };
    expect_cells(map, kAll, wanted);
    EXPECT_EQ(map.protected_areas().size(), 1u);
    map.unprotect();
    Map again = new_map(*d);
    again.integrate(first);
    again.integrate(second);
    EXPECT_EQ(again.hash(), whole.hash());
  }
}

TEST(Life, WhatIsProtectedOrWrittenIsNotForgotten) {
  const auto d = testing::drive(Model::li2014, 10, 7);
  Map map = new_map(*d, {.decay_s = 10}), plain = new_map(*d, {.decay_s = 10});
  map.integrate(d->scans), plain.integrate(d->scans);
  const CellRect area{-40, 3, 77, 41};
  map.advance_to(5'000'000'000), plain.advance_to(5'000'000'000);
  map.protect(area);
  EXPECT_EQ(map.hash(), plain.hash());
  map.write({500, 500, 1, 1}, std::vector<Mass>{{0, 0.5f, 0.5f}}, 1);
  Map then = new_map(*d, {.decay_s = 10});
  then.integrate(d->scans);
  then.advance_to(5'000'000'000);
  map.advance_to(90'000'000'000), plain.advance_to(90'000'000'000);
  expect_cells(map, kAll, [&](CellIndex c) { return inside(area, c) ? then.mass(c) : plain.mass(c); });
  EXPECT_EQ(map.mass({500, 500}).o, 0.5f);
}

TEST(Life, WrittenMassesAreReadBackUnderEveryRule) {
  std::vector<Mass> masses{{0.5f, 0.25f, 0.25f}, {}, {1, 0, 0}, {0, 0.875f, 0.125f}, {0.1f, 0.2f, 0.7f}, {0, 1, 0}};
  for (const Rule rule : map_rules()) {
    Map map({.rule = rule}, make_serial_executor());
    const CellRect rect{62, -1, 3, 2};  // over the corner of four tiles
    map.write(rect, masses, 3);
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const Mass m = masses[i], got = map.mass({rect.x + static_cast<int>(i) % 3, rect.y + static_cast<int>(i) / 3});
      switch (same_as(rule)) {
        case Rule::fuzzy:
          EXPECT_EQ(got.e, m.e);
          EXPECT_EQ(got.o, m.o);
          break;
        case Rule::bayes:
          EXPECT_NEAR(got.o + got.u / 2, std::clamp(m.o + m.u / 2, 0.001f, 0.999f), 2e-6);
          break;
        case Rule::cautious:
        case Rule::dempster_log:  // sources that leave less than 1e-4 are taken to leave this much
        case Rule::murphy:
          EXPECT_NEAR(got.e, m.e, m.u < 1e-4f ? 2e-4 : 2e-6) << name(rule) << i;
          EXPECT_NEAR(got.o, m.o, m.u < 1e-4f ? 2e-4 : 2e-6) << name(rule) << i;
          break;
        default:
          EXPECT_EQ(got.e, m.e) << name(rule);
          EXPECT_EQ(got.o, m.o);
          EXPECT_EQ(got.u, std::max(m.u, 1e-30f));
      }
    }
    EXPECT_EQ(map.mass({61, -1}), Mass{});
    EXPECT_EQ(map.version(), 1u);
  }
}

TEST(Life, APriorGridAndAFootprint) {
  Map map({.cell_m = 0.1}, make_serial_executor());
  const std::vector<std::int8_t> grid{0, 100, 50, -1};
  map.write({0, 0, 1, 1}, std::vector<Mass>{{0, 0.5f, 0.5f}}, 1);
  map.write({0, 0, 2, 2}, grid, 2, 0.8);
  EXPECT_EQ(map.mass({0, 0}).e, 0.8f);
  EXPECT_EQ(map.mass({1, 0}).o, 0.8f);
  EXPECT_NEAR(map.mass({0, 1}).e, 0.4, 1e-7);
  EXPECT_EQ(map.mass({1, 1}), Mass{});
  // A triangle, in both senses: the cells whose centres lie in it.
  for (const bool turned : {false, true}) {
    std::vector<Point2> corner{{-1, -1}, {2.03, -0.4}, {0.3, 1.7}};
    if (turned) std::swap(corner[0], corner[2]);
    Map one({.cell_m = 0.1}, make_serial_executor());
    one.write(corner, Mass{1, 0, 0});
    int cells = 0;
    for (std::int64_t y = -30; y < 30; ++y) {
      for (std::int64_t x = -30; x < 30; ++x) {
        const double px = 0.1 * (static_cast<double>(x) + 0.5), py = 0.1 * (static_cast<double>(y) + 0.5);
        // By the signs of the areas with the point, all alike inside.
        int sign = 0;
        for (int i = 0; i < 3; ++i) {
          const Point2 a = corner[static_cast<std::size_t>(i)], b = corner[static_cast<std::size_t>((i + 1) % 3)];
          sign += (a.x_m - px) * (b.y_m - py) - (b.x_m - px) * (a.y_m - py) > 0 ? 1 : -1;
        }
        const bool in = std::abs(sign) == 3;
        cells += in;
        ASSERT_EQ(one.mass({x, y}).e, in ? 1.0f : 0.0f) << x << ' ' << y;
      }
    }
    EXPECT_NEAR(cells, 100 * 0.5 * std::abs(3.03 * 2.7 - 1.3 * 0.6), 30);
  }
}

TEST(Life, WhatCannotBeWrittenIsNamedAndChangesNothing) {
  Map map({.cell_m = 0.1, .memory_cap_bytes = 4 * kTileBytes}, make_serial_executor());
  const std::vector<Mass> bad{{}, {0.5f, 0.6f, 0.1f}}, paradox{{0.5f, 0.2f, 0.2f, 0.1f}}, nan{{NAN, 0, 1}}, one{{}};
  EXPECT_NE(message([&] { map.write({5, 6, 2, 1}, bad, 2); }).find("cell (6, 6) does not add up"), std::string::npos);
  EXPECT_NE(message([&] { map.write({0, 0, 1, 1}, paradox, 1); }).find("empty ∩ occupied"), std::string::npos);
  EXPECT_NE(message([&] { map.write({0, 0, 1, 1}, nan, 1); }).find("outside [0, 1]"), std::string::npos);
  EXPECT_NE(message([&] { map.write({0, 0, 2, 1}, one, 2); }).find("smaller than the rectangle"), std::string::npos);
  const std::vector<std::int8_t> grid{101};
  EXPECT_NE(message([&] { map.write({0, 0, 1, 1}, grid, 1, 1); }).find("occupancy 101"), std::string::npos);
  EXPECT_NE(message([&] {
              map.write({0, 0, 1, 1}, std::vector<std::int8_t>{1}, 1, 0);
            }).find("certainty"),
            std::string::npos);
  const std::vector<Point2> two{{0, 0}, {1, 1}}, far{{0, 0}, {INFINITY, 1}, {0, 1}};
  EXPECT_NE(message([&] { map.write(two, Mass{1, 0, 0}); }).find("three corners"), std::string::npos);
  EXPECT_NE(message([&] { map.write(far, Mass{1, 0, 0}); }).find("not finite"), std::string::npos);
  const std::vector<Mass> much(65 * 400, Mass{1, 0, 0});
  EXPECT_THROW(map.write({0, 0, 400, 65}, much, 400), std::length_error);
  EXPECT_EQ(map.tiles(), 0u);
  EXPECT_EQ(map.version(), 0u);
}

TEST(Life, AWriteThatDoesNotFitMakesNoTiles) {
  Map map({.cell_m = 0.1, .memory_cap_bytes = 4 * kTileBytes}, make_serial_executor());
  const std::vector<Mass> row(3 * 64, Mass{1, 0, 0});
  map.write({0, 0, 2 * 64, 1}, row, 2 * 64);
  const std::uint64_t version = map.version();
  std::optional<MapView> view = map.view();  // two tiles to be copied and a new one, beside the two that the view holds
  EXPECT_THROW(map.write({0, 0, 3 * 64, 1}, row, 3 * 64), std::length_error);
  EXPECT_EQ(map.tiles(), 2u);
  EXPECT_EQ(map.memory_bytes(), 2 * kTileBytes);
  EXPECT_EQ(map.version(), version);
  view.reset();
  map.write({0, 0, 3 * 64, 1}, row, 3 * 64);
  EXPECT_EQ(map.tiles(), 3u);
}

TEST(Life, TwoToTheFortyCellsAreThereAndCostNothing) {
  const auto d = testing::drive(Model::li2014, 2, 1);
  Map map = new_map(*d);
  const double far_m = (std::int64_t{1} << 20) * 0.05;  // 2^20 cells each way
  for (const double x : {0.0, far_m}) {
    for (const double y : {0.0, far_m}) {
      Scan s = d->scans[1];
      s.T_map_robot = {x, y, 0.3};
      map.integrate(s);
    }
  }
  const CellRect b = map.bounds();
  EXPECT_GE(b.width * b.height, std::int64_t{1} << 40);
  EXPECT_LT(map.memory_bytes(), std::size_t{16} << 20);
  const CellIndex here = map.cell_at(0.5, 0.1);
  EXPECT_EQ(map.mass(here), map.mass({here.x + (1 << 20), here.y + (1 << 20)}));
  EXPECT_FALSE(map.mass(here) == Mass{});
  map.set_window({b.x, b.y, 200, 200});
  EXPECT_LT(map.bounds().width, 500);
}

TEST(Life, RectanglesWhoseSidesOverflowAreRefused) {
  Map map;
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  std::vector<float> out(16);
  std::vector<Mass> masses(16);
  for (const CellRect far : {CellRect{kMost - 2, 0, 4, 4}, CellRect{0, -kMost, 4, 4}, CellRect{0, 0, kMost, 4},
                             CellRect{-kMost, -kMost, kMost, kMost}}) {
    const auto refused = [&](auto&& call) {
      EXPECT_NE(message(call).find("beyond 2^60 cells"), std::string::npos) << far.x << " " << far.width;
    };
    refused([&] { map.render(Layer::betp, far, out, 4); });
    refused([&] { map.clear(far); });
    refused([&] { map.set_window(far); });
    refused([&] { map.protect(far); });
    refused([&] { map.write(far, masses, 4); });
  }
  // As many rows as the product of height and stride overflows with.
  const CellRect tall{0, 0, 4, std::int64_t{1} << 60};
  EXPECT_NE(message([&] { map.render(Layer::betp, tall, out, std::int64_t{1} << 40); }).find("smaller"),
            std::string::npos);
  const CellRect everything{-(std::int64_t{1} << 60), -(std::int64_t{1} << 60), std::int64_t{1} << 61,
                            std::int64_t{1} << 61};
  map.set_window(everything);
  map.protect(everything);
  map.clear(everything);
}

}  // namespace
}  // namespace evigrid
