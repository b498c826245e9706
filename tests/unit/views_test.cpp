// SPDX-License-Identifier: Apache-2.0
// Views: each stays the map it was made of, whatever the writer does next, and costs what it says. What a view must
// hold is known from maps that never had one.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

using testing::Drive;

Map empty_map(const Drive& d, MapParams params, std::shared_ptr<Executor> executor = make_serial_executor()) {
  Map map(params, std::move(executor));
  for (const Sensor& s : d.sensors) map.add(s);
  return map;
}
/// The first `steps` scans of the drive, far apart enough to make many tiles.
Scan far_scan(const Drive& d, std::size_t i) {
  Scan s = d.scans[i];
  s.T_map_robot.x_m += 4.0 * static_cast<double>(i % 7);
  s.T_map_robot.y_m -= 3.0 * static_cast<double>(i % 5);
  return s;
}
template <class MapOrView>
std::string bytes_of(const MapOrView& m) {
  std::ostringstream out;
  save(m, out);
  return out.str();
}
std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>> sorted(const Changes& c) {
  std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>> out;
  for (const CellRect& r : c.rects) out.emplace_back(r.x, r.y, r.width, r.height);
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Views, StayAsTheyWereAndTheMapGoesOnAsIfThereWereNone) {
  const auto d = testing::drive(Model::li2014, 30, 11);
  for (const Rule rule : {Rule::pcr5, Rule::dempster_log, Rule::conjunctive}) {
    for (const int threads : {1, 3}) {
      const MapParams params{.cell_m = 0.1, .rule = rule};
      Map plain = empty_map(*d, params), seen = empty_map(*d, params, make_openmp_executor(threads));
      std::vector<std::pair<MapView, std::uint64_t>> views;
      for (std::size_t i = 0; i < d->scans.size(); ++i) {
        plain.integrate(far_scan(*d, i));
        seen.integrate(far_scan(*d, i));
        if (i % 4 == 0) views.emplace_back(seen.view(), plain.hash());
        if (i % 9 == 0) views.erase(views.begin());  // views go in another order than they came
        ASSERT_EQ(seen.hash(), plain.hash()) << name(rule) << i;
        for (const auto& [view, hash] : views) ASSERT_EQ(view.hash(), hash) << name(rule) << i;
      }
    }
  }
}

TEST(Views, ReadAsTheMapDidThen) {
  const auto d = testing::drive(Model::hughes1992, 16, 4);
  const MapParams params{.cell_m = 0.1, .rule = Rule::pcr5, .keep_con = true, .keep_last_conflict = true};
  Map map = empty_map(*d, params), then = empty_map(*d, params);
  for (std::size_t i = 0; i < 8; ++i) map.integrate(far_scan(*d, i)), then.integrate(far_scan(*d, i));
  const MapView view = map.view();
  const std::string bytes = bytes_of(then);
  for (std::size_t i = 8; i < 16; ++i) map.integrate(far_scan(*d, i));
  ASSERT_NE(map.hash(), then.hash());
  EXPECT_EQ(bytes_of(view), bytes);  // the file of the map then, last stamp and all
  EXPECT_EQ(view.bounds(), then.bounds());
  EXPECT_EQ(view.version(), then.version());
  EXPECT_EQ(view.tiles(), then.tiles());
  EXPECT_EQ(view.sensors().size(), d->sensors.size());
  EXPECT_EQ(view.params().rule, Rule::pcr5);
  const CellRect rect{-50, -200, 500, 400};
  for (const Layer layer : all_layers()) {
    std::vector<float> a(static_cast<std::size_t>(rect.width * rect.height)), b = a;
    view.render(layer, rect, a, rect.width);
    then.render(layer, rect, b, rect.width);
    ASSERT_TRUE(a == b) << name(layer);
  }
  std::vector<std::uint8_t> a(static_cast<std::size_t>(rect.width * rect.height)), b = a;
  view.render(Costmap{}, rect, a, rect.width);
  then.render(Costmap{}, rect, b, rect.width);
  EXPECT_TRUE(a == b);
  std::vector<std::int8_t> c(a.size()), e(a.size());
  view.render(Costmap{}, rect, c, rect.width);
  then.render(Costmap{}, rect, e, rect.width);
  EXPECT_TRUE(c == e);
  for (std::int64_t x = -20; x < 60; ++x) {
    const CellIndex at{x, 3};
    ASSERT_EQ(view.mass(at), then.mass(at));
    ASSERT_EQ(view.conflict(at), then.conflict(at));
    ASSERT_EQ(view.con(at), then.con(at));
    ASSERT_EQ(view.last_conflict(at), then.last_conflict(at));
  }
  EXPECT_EQ(view.cell_at(1.23, -4.56), then.cell_at(1.23, -4.56));
}

TEST(Views, TellWhatChangedUpToThem) {
  const auto d = testing::drive(Model::li2014, 24, 2);
  Map map = empty_map(*d, {.cell_m = 0.1});
  std::vector<MapView> views;
  std::vector<std::vector<Changes>> told;  // by the map, when each view was made
  for (std::size_t i = 0; i < 24; ++i) {
    map.integrate(far_scan(*d, i));
    if (i == 12) map.clear();
    if (i % 3 != 0) continue;
    views.push_back(map.view());
    told.emplace_back();
    for (std::uint64_t since = 0; since <= map.version(); ++since) told.back().push_back(map.changes(since));
  }
  for (std::size_t v = 0; v < views.size(); ++v) {
    ASSERT_EQ(views[v].version() + 1, told[v].size());
    for (std::uint64_t since = 0; since < told[v].size(); ++since) {
      const Changes now = views[v].changes(since);
      EXPECT_EQ(now.version, told[v][since].version);
      EXPECT_EQ(now.cleared, told[v][since].cleared);
      EXPECT_EQ(sorted(now), sorted(told[v][since])) << v << ' ' << since;
    }
  }
}

TEST(Views, CopyEachTileOnceAndGiveItBack) {
  const auto d = testing::drive(Model::li2014, 12, 9);
  Map map = empty_map(*d, {.cell_m = 0.1});
  for (std::size_t i = 0; i < 12; ++i) map.integrate(far_scan(*d, i));
  const std::size_t alone = map.memory_bytes(), tile = alone / map.tiles();
  ASSERT_EQ(alone % map.tiles(), 0u);
  {
    const MapView first = map.view();
    EXPECT_EQ(map.memory_bytes(), alone);  // a view alone copies nothing
    map.integrate(far_scan(*d, 3));
    const std::size_t once = map.memory_bytes();
    EXPECT_GT(once, alone);
    EXPECT_LT(once, 2 * alone);  // what was not touched is shared
    map.integrate(far_scan(*d, 3));
    EXPECT_EQ(map.memory_bytes(), once);  // the copy is the writer's own
    {
      const MapView second = map.view(), same = second;
      map.integrate(far_scan(*d, 3));
      EXPECT_EQ(map.memory_bytes(), once + (once - alone));
    }
    EXPECT_EQ(map.memory_bytes(), once);  // only `first` is left
    EXPECT_EQ((once - alone) % tile, 0u);
  }
  EXPECT_EQ(map.memory_bytes(), alone);
  std::optional<MapView> last = map.view();
  map.clear();
  EXPECT_EQ(map.memory_bytes(), alone);
  last.reset();
  EXPECT_EQ(map.memory_bytes(), 0u);
}

TEST(Views, OutliveTheirMap) {
  const auto d = testing::drive(Model::li2014, 4, 1);
  std::optional<Map> map(empty_map(*d, {}));
  map->integrate(d->scans);
  const std::uint64_t hash = map->hash();
  const MapView view = map->view();
  Map moved = std::move(*map);
  map.reset();
  EXPECT_EQ(view.hash(), hash);
  moved.integrate(d->scans);
  EXPECT_EQ(view.hash(), hash);
  EXPECT_NE(moved.hash(), hash);
}

TEST(Views, CountUnderTheMemoryCapAndALackIsNamed) {
  const auto d = testing::drive(Model::li2014, 4, 1);
  Map map = empty_map(*d, {});
  map.integrate(d->scans);
  Map tight = empty_map(*d, {.memory_cap_bytes = map.memory_bytes()});
  tight.integrate(d->scans);
  std::optional<MapView> view = tight.view();
  try {
    tight.integrate(d->scans);
    FAIL() << "no room for copies";
  } catch (const std::length_error& e) {
    EXPECT_NE(std::string(e.what()).find("those that views hold"), std::string::npos) << e.what();
  }
  EXPECT_EQ(tight.hash(), map.hash());  // nothing was half done
  EXPECT_EQ(view->hash(), map.hash());
  view.reset();
  tight.integrate(d->scans);
  map.integrate(d->scans);
  EXPECT_EQ(tight.hash(), map.hash());
}

/// Whatever the order of fusing, viewing, forgetting and clearing.
TEST(Views, RandomLives) {
  const auto d = testing::drive(Model::li2014, 40, 21);
  for (unsigned seed = 0; seed < 3; ++seed) {
    std::mt19937 random(seed);
    Map map = empty_map(*d, {.cell_m = 0.2});
    std::vector<std::pair<MapView, std::uint64_t>> views;
    for (int step = 0; step < 150; ++step) {
      switch (random() % 8) {
        case 0:
        case 1:
          views.emplace_back(map.view(), map.hash());
          break;
        case 2:
        case 3:
          if (!views.empty()) views.erase(views.begin() + static_cast<std::ptrdiff_t>(random() % views.size()));
          break;
        case 4:
          if (random() % 6 == 0) map.clear();
          break;
        default:
          map.integrate(far_scan(*d, random() % 40));
      }
      for (const auto& [view, hash] : views) ASSERT_EQ(view.hash(), hash) << seed << ' ' << step;
      const std::size_t all = map.memory_bytes();
      ASSERT_GE(all, map.tiles() * (64 * 64 * 4 * sizeof(float)));
      if (views.empty()) {
        ASSERT_EQ(all, map.tiles() * (64 * 64 * 4 * sizeof(float)));
      }
    }
  }
}

TEST(Views, ShowTheirTilesWhereTheyLie) {
  const auto d = testing::drive(Model::li2014, 12, 5);
  for (const Rule rule : {Rule::pcr5, Rule::conjunctive}) {
    Map map = empty_map(*d, {.cell_m = 0.1, .rule = rule, .keep_con = true});
    map.integrate(d->scans);
    const MapView view = map.view();
    const auto names = view.plane_names();
    const auto plane = [&](std::string_view name) {
      const auto at = std::find(names.begin(), names.end(), name);
      EXPECT_NE(at, names.end()) << name;
      return static_cast<int>(at - names.begin());
    };
    const int e = plane("e"), o = plane("o"), u = plane("u"), conflict = plane("conflict"), con = plane("con");
    const auto tiles = view.tile_planes();
    ASSERT_EQ(tiles.size(), map.tiles());
    const float* const before = tiles.front().data;
    map.integrate(d->scans.front());  // the writer goes on in a copy
    EXPECT_EQ(view.tile_planes().front().data, before);
    std::size_t seen = 0;
    for (const TilePlanes& tile : tiles) {
      ASSERT_EQ(tile.planes, static_cast<int>(names.size()));
      for (std::int64_t y = 0; y < TilePlanes::kSide; ++y) {
        for (std::int64_t x = 0; x < TilePlanes::kSide; ++x) {
          const CellIndex cell{tile.rect.x + x, tile.rect.y + y};
          const Mass m = view.mass(cell);
          ASSERT_EQ(tile.at(e, x, y), m.e);
          ASSERT_EQ(tile.at(o, x, y), m.o);
          ASSERT_EQ(tile.at(u, x, y), m.u);
          ASSERT_EQ(tile.at(conflict, x, y), view.conflict(cell));
          ASSERT_EQ(tile.at(con, x, y), view.con(cell));
          seen += m == Mass{} ? 0 : 1;
        }
      }
    }
    EXPECT_GT(seen, 1000u);
  }
}

TEST(Views, AScanThatDoesNotFitBesideThemLeavesNoTilesBehind) {
  constexpr std::size_t kTile = 64 * 64 * 4 * sizeof(float);  // e, o, u and the sum of conflict
  Map map({.rule = Rule::dempster, .memory_cap_bytes = 4 * kTile}, make_serial_executor());
  Sensor s;
  s.aperture_rad = 0.05;
  s.max_range_m = 8;
  const SensorId id = map.add(s);
  const std::vector<Mass> wall{{0, 0.9f, 0.1f}};
  map.write({5, 5, 1, 1}, wall, 1);
  map.write({70, 5, 1, 1}, wall, 1);
  ASSERT_EQ(map.memory_bytes(), 2 * kTile);
  const std::uint64_t before = map.hash();
  std::optional<MapView> view = map.view();
  const float range_m = 6;
  const Reading reading{id, {&range_m, 1}};
  const Scan through_three_tiles{1, {1, 1.6, 0}, {&reading, 1}};
  // The third tile has room, the copies of the two that the view sees have not.
  EXPECT_THROW(map.integrate(through_three_tiles), std::length_error);
  EXPECT_EQ(map.tiles(), 2u);
  EXPECT_EQ(map.memory_bytes(), 2 * kTile);
  EXPECT_EQ(map.hash(), before);
  view.reset();
  EXPECT_GT(map.integrate(through_three_tiles).cells_updated, 100u);
  EXPECT_EQ(map.tiles(), 3u);
}

}  // namespace
}  // namespace evigrid
