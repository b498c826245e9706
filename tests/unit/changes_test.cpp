// SPDX-License-Identifier: Apache-2.0
// Map::changes: a consumer that renders only what is listed holds the same picture as one that renders everything, and
// little more than what readings reached is listed.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

constexpr CellRect kWindow{-300, -300, 600, 600};

Map with_sensors(std::shared_ptr<Executor> executor) {
  Map map({.cell_m = 0.05, .rule = Rule::pcr5}, std::move(executor));
  Sensor cone;
  cone.aperture_rad = 0.4;
  map.add(cone);
  Sensor fan;
  fan.model = Model::beam;
  fan.beams = 40;
  fan.first_beam_rad = -1;
  fan.beam_step_rad = 0.05;
  map.add(fan);
  return map;
}

/// A scan of both sensors somewhere in the window.
Report see(Map& map, std::mt19937& random) {
  std::uniform_real_distribution<double> at(-8, 8), yaw(-3, 3), range(0.3, 4.5);
  const float one = static_cast<float>(range(random));
  std::vector<float> many(40, 4.5f);  // smooth: most of it is empty
  many[7] = static_cast<float>(range(random));
  const Reading readings[2]{{0, {&one, 1}}, {1, many}};
  return map.integrate(Scan{0, {at(random), at(random), yaw(random)}, readings});
}

std::vector<std::uint8_t> whole(const Map& map) {
  std::vector<std::uint8_t> out(static_cast<std::size_t>(kWindow.width * kWindow.height));
  map.render(Costmap{}, kWindow, out, kWindow.width);
  return out;
}

/// What a host does: a picture of the window, brought up to date by what changed.
struct Consumer {
  std::uint64_t version = 0;
  std::vector<std::uint8_t> costs =
      std::vector<std::uint8_t>(static_cast<std::size_t>(kWindow.width * kWindow.height), 255);
  std::int64_t drawn = 0;

  void update(const Map& map) {
    const Changes changes = map.changes(version);
    version = changes.version;
    if (changes.cleared) std::fill(costs.begin(), costs.end(), std::uint8_t{255});
    for (const CellRect& r : changes.rects) {
      const auto first = static_cast<std::size_t>((r.y - kWindow.y) * kWindow.width + r.x - kWindow.x);
      ASSERT_LE(first, costs.size());
      map.render(Costmap{}, r, std::span(costs).subspan(first), kWindow.width);
      drawn += r.width * r.height;
    }
  }
};

TEST(Changes, AConsumerThatRendersThemAloneHoldsTheWholePicture) {
  for (const int threads : {1, 3}) {
    std::mt19937 random(7);
    Map map = with_sensors(make_openmp_executor(threads));
    Consumer each, third;
    for (int i = 0; i < 60; ++i) {
      see(map, random);
      each.update(map);
      if (i % 3 == 0) third.update(map);  // two consumers do not disturb one another
      if (i == 40) {
        map.clear();
        ASSERT_TRUE(map.changes(each.version).cleared);
      }
      if (i % 10 == 9) {
        each.update(map);
        third.update(map);
        const auto all = whole(map);
        ASSERT_TRUE(each.costs == all) << i;
        ASSERT_TRUE(third.costs == all) << i;
        ASSERT_TRUE(map.changes(each.version).rects.empty());
      }
    }
  }
}

TEST(Changes, ListTilesOnceTheLatestFirstAndNotMuchMoreThanWasReached) {
  std::mt19937 random(3);
  Map map = with_sensors(make_serial_executor());
  std::uint64_t before = 0;
  for (int i = 0; i < 30; ++i) {
    const Report report = see(map, random);
    const Changes now = map.changes(before);
    EXPECT_EQ(now.version, before + 1);
    EXPECT_FALSE(now.cleared);
    std::int64_t area = 0;
    std::vector<std::pair<std::int64_t, std::int64_t>> tiles;
    for (const CellRect& r : now.rects) {
      EXPECT_EQ(r.x >> 6, (r.x + r.width - 1) >> 6);  // within one tile
      EXPECT_EQ(r.y >> 6, (r.y + r.height - 1) >> 6);
      EXPECT_GE(r.x, report.touched.x);
      EXPECT_LE(r.y + r.height, report.touched.y + report.touched.height);
      tiles.emplace_back(r.x >> 6, r.y >> 6);
      area += r.width * r.height;
    }
    std::sort(tiles.begin(), tiles.end());
    EXPECT_EQ(std::adjacent_find(tiles.begin(), tiles.end()), tiles.end());
    // One cone and one fan of 2 rad: their box is a few times their area; whole tiles would be more.
    EXPECT_LT(area, static_cast<std::int64_t>(now.rects.size()) * 4096);
    before = now.version;
  }
  // The last scan's tiles come first.
  const Changes last = map.changes(before - 1), all = map.changes(0);
  ASSERT_LT(last.rects.size(), all.rects.size());
  std::vector<std::pair<std::int64_t, std::int64_t>> first_of_all, of_last;
  for (std::size_t i = 0; i < last.rects.size(); ++i) {
    first_of_all.emplace_back(all.rects[i].x >> 6, all.rects[i].y >> 6);
    of_last.emplace_back(last.rects[i].x >> 6, last.rects[i].y >> 6);
  }
  EXPECT_EQ(first_of_all, of_last);
}

TEST(Changes, WhatChangesNothingIsNoNewVersion) {
  Map map = with_sensors(make_serial_executor());
  EXPECT_EQ(map.version(), 0u);
  const float refused = -1;
  const Reading reading{0, {&refused, 1}};
  map.integrate(Scan{0, {}, {&reading, 1}});
  EXPECT_EQ(map.version(), 0u);
  EXPECT_FALSE(map.changes(0).cleared);
  map.clear();
  EXPECT_EQ(map.version(), 1u);
  EXPECT_TRUE(map.changes(0).cleared);
  EXPECT_FALSE(map.changes(1).cleared);
}

TEST(Changes, ALoadedMapIsNewAsAWhole) {
  std::mt19937 random(5);
  Map map = with_sensors(make_serial_executor());
  for (int i = 0; i < 5; ++i) see(map, random);
  std::stringstream file;
  save(map, file);
  const std::string bytes = file.str();
  Map loaded = load(std::as_bytes(std::span(bytes)), {.executor = make_serial_executor()});
  Consumer consumer;
  consumer.update(loaded);
  EXPECT_TRUE(consumer.costs == whole(map));
  see(loaded, random);
  consumer.update(loaded);
  EXPECT_TRUE(consumer.costs == whole(loaded));
}

TEST(Changes, WhereTooMuchWasDroppedAllThatIsLeftIsListed) {
  Map map({.rule = Rule::dempster}, make_serial_executor());
  const std::vector<Mass> wall{{0, 0.9f, 0.1f}};
  const CellIndex stays{-640, 5};
  map.write({stays.x, stays.y, 1, 1}, wall, 1);
  for (std::int64_t i = 0; i < 4200; ++i) map.write({64 * i, 64, 1, 1}, wall, 1);
  const std::uint64_t drawn = map.version();
  map.clear({0, 0, 64 * 4200, 128});  // more tiles than are remembered one by one
  const MapView view = map.view();
  for (const Changes& c : {map.changes(drawn), view.changes(drawn)}) {
    EXPECT_TRUE(c.cleared);
    EXPECT_TRUE(std::any_of(c.rects.begin(), c.rects.end(), [&](const CellRect& r) {
      return stays.x >= r.x && stays.x < r.x + r.width && stays.y >= r.y && stays.y < r.y + r.height;
    }));
  }
}

// A fan may reach a tile by a corner in which no cell lies: the tile is made, never changed, and dropped once more.
TEST(Changes, ATileThatIsDroppedTwiceIsListedOnce) {
  Map map = with_sensors(make_serial_executor());
  const CellRect all{-640, -640, 1280, 1280};
  const std::vector<Mass> wall(static_cast<std::size_t>(all.width * all.height), Mass{0, 0.9f, 0.1f});
  map.write(all, wall, all.width);
  const std::size_t written = map.tiles();
  map.clear(all);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> range_m(0.3f, 4.5f);
  std::size_t never_changed = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<float> ranges_m(40, range_m(random));
    const Reading reading{1, ranges_m};
    const std::uint64_t before = map.version();
    map.integrate(Scan{0, {0.013 * i, -0.017 * i, 0.0314 * i}, {&reading, 1}});
    never_changed += map.tiles() - map.changes(before).rects.size();
    map.clear(all);
  }
  ASSERT_GT(never_changed, 0U);
  const MapView view = map.view();
  for (const Changes& c : {map.changes(0), view.changes(0)}) {
    EXPECT_FALSE(c.cleared);
    std::vector<std::pair<std::int64_t, std::int64_t>> tiles;
    for (const CellRect& r : c.rects) tiles.emplace_back(r.x, r.y);
    std::sort(tiles.begin(), tiles.end());
    EXPECT_EQ(std::adjacent_find(tiles.begin(), tiles.end()), tiles.end());
    EXPECT_EQ(tiles.size(), written);
  }
}

}  // namespace
}  // namespace evigrid
