// SPDX-License-Identifier: Apache-2.0
// The public face of a map: vacuous at first, readable everywhere, bounded in memory, independent of how it was fed.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

struct Fed {
  Map map;
  SensorId id;
};
Fed fresh(MapParams p = {}) {
  Map map(p, make_serial_executor());
  Sensor s;
  s.aperture_rad = 0.4;
  const SensorId id = map.add(s);
  return {std::move(map), id};
}
Report see(Fed& f, float range, Pose2 pose = {}) {
  const Reading reading{f.id, {&range, 1}};
  return f.map.integrate(Scan{0, pose, {&reading, 1}});
}

TEST(Map, StartsVacuousAndClears) {
  Fed f = fresh();
  const std::uint64_t empty = f.map.hash();
  EXPECT_EQ(f.map.mass({3, -4}), (Mass{0, 0, 1}));
  EXPECT_TRUE(f.map.bounds().empty());
  see(f, 2);
  EXPECT_NE(f.map.hash(), empty);
  EXPECT_GT(f.map.memory_bytes(), 0u);
  f.map.clear();
  EXPECT_EQ(f.map.hash(), empty);
  EXPECT_EQ(f.map.memory_bytes(), 0u);
}

TEST(Map, AConeIsEmptyBeforeTheArcAndOccupiedOnIt) {
  Fed f = fresh();
  const Report r = see(f, 2);
  const Mass before = f.map.mass(f.map.cell_at(1.0, 0.01)), arc = f.map.mass(f.map.cell_at(2.0, 0.01));
  EXPECT_GT(before.e, 0.6f);
  EXPECT_GT(arc.o, 0.8f);
  EXPECT_EQ(f.map.mass(f.map.cell_at(-0.5, 0)), Mass{});
  EXPECT_EQ(f.map.mass(f.map.cell_at(2.5, 0)), Mass{});
  const CellRect b = f.map.bounds();
  EXPECT_GE(b.x, 1);  // min_range 0.1 m
  EXPECT_LE(b.x + b.width, 42);
  EXPECT_GE(r.touched.width, b.width);
}

TEST(Map, RendersEveryLayerIntoACallersBuffer) {
  Fed f = fresh();
  see(f, 2);
  see(f, 1);
  const CellRect rect{-5, -70, 80, 140};
  const std::ptrdiff_t stride = 96;
  std::vector<float> betp(static_cast<std::size_t>(stride) * 140, -7), bel = betp, pl = betp, e = betp, u = betp,
                                                                       k = betp;
  f.map.render(Layer::betp, rect, betp, stride);
  f.map.render(Layer::bel, rect, bel, stride);
  f.map.render(Layer::pl, rect, pl, stride);
  f.map.render(Layer::empty, rect, e, stride);
  f.map.render(Layer::unknown, rect, u, stride);
  f.map.render(Layer::conflict, rect, k, stride);
  float most_conflict = 0;
  for (std::int64_t y = 0; y < rect.height; ++y) {
    for (std::int64_t x = 0; x < stride; ++x) {
      const auto i = static_cast<std::size_t>(y * stride + x);
      if (x >= rect.width) {
        ASSERT_EQ(betp[i], -7);  // beyond the rectangle nothing is written
        continue;
      }
      const Mass m = f.map.mass({rect.x + x, rect.y + y});
      ASSERT_EQ(betp[i], m.o + m.u * 0.5f);
      ASSERT_EQ(bel[i], m.o);
      ASSERT_EQ(pl[i], m.o + m.u);
      ASSERT_EQ(e[i], m.e);
      ASSERT_EQ(u[i], m.u);
      ASSERT_EQ(k[i], f.map.conflict({rect.x + x, rect.y + y}));
      most_conflict = std::max(most_conflict, k[i]);
    }
  }
  EXPECT_GT(most_conflict, 0.3f);  // the nearer arc lies where the first reading said empty
  std::vector<float> small(10);
  EXPECT_THROW(f.map.render(Layer::betp, rect, small, 80), std::invalid_argument);
  EXPECT_THROW(f.map.render(Layer::betp, rect, betp, 79), std::invalid_argument);
}

TEST(Costmap, ValuesOfBothKindsAtTheirBorders) {
  const Costmap c{};
  struct Row {
    Mass m;
    int occupancy, cost;
  };
  for (const Row& row : {Row{{0, 0, 1}, -1, 255},              // never seen
                         Row{{0.04f, 0.05f, 0.91f}, -1, 255},  // hardly seen
                         Row{{0.05f, 0.05f, 0.9f}, 67, 169},  // BetP 1/2: 1 + 98 · 0.304/0.454, 1 + 251 · 0.304/0.454
                         Row{{1, 0, 0}, 0, 0}, Row{{0.81f, 0.19f, 0}, 0, 0}, Row{{0.803f, 0.197f, 0}, 1, 2},
                         Row{{0.351f, 0.649f, 0}, 99, 251}, Row{{0.34f, 0.66f, 0}, 100, 254}, Row{{0, 1, 0}, 100, 254},
                         Row{{0, 0.4f, 0.6f}, 100, 254}}) {
    EXPECT_EQ(occupancy_of(c, row.m), row.occupancy) << row.m.e << ' ' << row.m.o;
    EXPECT_EQ(cost_of(c, row.m), row.cost) << row.m.e << ' ' << row.m.o;
  }
}

TEST(Costmap, RendersIntoTheHostsBufferAndNothingBeside) {
  Fed f = fresh();
  see(f, 2);
  see(f, 1.5f);
  const CellRect rect{-3, -20, 50, 40};
  const std::ptrdiff_t stride = 55;
  std::vector<std::int8_t> grid(static_cast<std::size_t>(stride) * 40, 77);
  std::vector<std::uint8_t> costs(grid.size(), 77);
  f.map.render(Costmap{}, rect, grid, stride);
  f.map.render(Costmap{}, rect, costs, stride);
  int lethal = 0, none = 0, free = 0;
  for (std::int64_t y = 0; y < rect.height; ++y) {
    for (std::int64_t x = 0; x < stride; ++x) {
      const auto i = static_cast<std::size_t>(y * stride + x);
      if (x >= rect.width) {
        ASSERT_EQ(grid[i], 77);
        ASSERT_EQ(costs[i], 77);
        continue;
      }
      const Mass m = f.map.mass({rect.x + x, rect.y + y});
      ASSERT_EQ(grid[i], occupancy_of({}, m));
      ASSERT_EQ(costs[i], cost_of({}, m));
      lethal += costs[i] == 254, none += costs[i] == 255, free += costs[i] == 0;
      ASSERT_EQ(costs[i] == 254, grid[i] == 100);
      ASSERT_EQ(costs[i] == 255, grid[i] == -1);
      ASSERT_NE(costs[i], 253);
    }
  }
  EXPECT_GT(lethal, 0);
  EXPECT_GT(none, 0);
  EXPECT_GT(free, 0);
  EXPECT_THROW(f.map.render(Costmap{.free_below = 0.7}, rect, costs, stride), std::invalid_argument);
  EXPECT_THROW(f.map.render(Costmap{.lethal_above = 1.1}, rect, grid, stride), std::invalid_argument);
  EXPECT_THROW(f.map.render(Costmap{}, rect, costs, 49), std::invalid_argument);
}

TEST(Map, BatchesAreTheSameAsSingleScans) {
  Fed a = fresh(), b = fresh();
  std::vector<float> ranges;
  for (int i = 0; i < 60; ++i) ranges.push_back(0.5f + 0.04f * static_cast<float>(i));
  std::vector<Reading> readings;
  for (auto& r : ranges) readings.push_back({0, {&r, 1}});
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < ranges.size(); ++i)
    scans.push_back({static_cast<std::int64_t>(i),
                     {0.1 * static_cast<double>(i), -3, 0.3 * static_cast<double>(i)},
                     {&readings[i], 1}});
  Report one, all = b.map.integrate(scans);
  for (const auto& s : scans) one += a.map.integrate(s);
  EXPECT_EQ(a.map.hash(), b.map.hash());
  EXPECT_EQ(one.cells_updated, all.cells_updated);
  EXPECT_EQ(one.max_conflict, all.max_conflict);
}

TEST(Map, TheOrderOfReadingsIsPartOfTheResult) {
  Fed a = fresh(), b = fresh();
  see(a, 2), see(a, 1), see(a, 1.5f);
  see(b, 1.5f), see(b, 1), see(b, 2);
  EXPECT_NE(a.map.hash(), b.map.hash());  // PCR5 is not associative
}

TEST(Map, ConflictPlaneIsOptionalAndChangesNoMass) {
  Fed with = fresh(), without = fresh({.keep_conflict = false});
  for (Fed* f : {&with, &without}) see(*f, 2), see(*f, 1);
  EXPECT_EQ(with.map.hash(), without.map.hash());
  EXPECT_GT(with.map.memory_bytes(), without.map.memory_bytes());
  EXPECT_EQ(without.map.conflict(without.map.cell_at(1, 0)), 0);
}

TEST(Map, MemoryCapIsNamedAndLeavesTheMapAsItWas) {
  Fed f = fresh({.memory_cap_bytes = std::size_t{6} << 16});
  see(f, 2);
  const std::uint64_t before = f.map.hash();
  EXPECT_THROW(
      {
        try {
          for (int i = 1; i < 10; ++i) see(f, 5, {50.0 * i, 0, 0.5});
        } catch (const std::length_error& e) {
          EXPECT_NE(std::string(e.what()).find("memory_cap_bytes"), std::string::npos);
          throw;
        }
      },
      std::length_error);
  f.map.clear();
  see(f, 2);
  EXPECT_EQ(f.map.hash(), before);
}

TEST(Map, HashSeesOneBitAndNotTheTiles) {
  Fed a = fresh(), b = fresh();
  see(a, 2), see(b, 2);
  EXPECT_EQ(a.map.hash(), b.map.hash());
  see(b, 2, {1e-4, 0, 0});
  EXPECT_NE(a.map.hash(), b.map.hash());
}

TEST(Map, PlacesThatNoCellHasAreAnsweredByTheFarthest) {
  const Map map({.cell_m = 0.05}, make_serial_executor());
  const std::int64_t far = std::int64_t{1} << 61;
  EXPECT_EQ(map.cell_at(1e300, -1e300), (CellIndex{far, -far}));
  EXPECT_EQ(map.cell_at(std::nan(""), 0.12), (CellIndex{-far, 2}));
  EXPECT_EQ(map.mass(map.cell_at(std::nan(""), 1e300)), Mass{});
}

TEST(Map, WhatIsNoPlaceHasNothingEvenInAMapThatReachesToTheEnd) {
  Map map({.cell_m = 0.05}, make_serial_executor());
  const std::int64_t end = -(std::int64_t{1} << 60);
  map.write({end, end, 1, 1}, std::vector<Mass>{{1, 0, 0}}, 1);
  EXPECT_EQ(map.mass(map.cell_at(std::nan(""), std::nan(""))), Mass{});
}

}  // namespace
}  // namespace evigrid
