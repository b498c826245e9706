// SPDX-License-Identifier: Apache-2.0
// The small parts of `cycle`: queue, percentiles, search, chart ticks, the consumer's costmap, options.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

#include "evigrid/bounded_queue.hpp"
#include "cycle/cost_tiles.hpp"
#include "cycle/find_max.hpp"
#include "cycle/fleet_options.hpp"
#include "cycle/percentiles.hpp"
#include "error.hpp"
#include "fake_fleet.hpp"
#include "picture/chart.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

TEST(BoundedQueue, IsFirstInFirstOutAndRefusesWhatHasNoRoom) {
  BoundedQueue<std::unique_ptr<int>> queue(3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.try_push(std::make_unique<int>(i)));
  auto fourth = std::make_unique<int>(3);
  EXPECT_FALSE(queue.try_push(std::move(fourth)));
  ASSERT_TRUE(fourth);  // still the producer's
  EXPECT_EQ(queue.room(), 0u);
  std::vector<std::unique_ptr<int>> out;
  EXPECT_EQ(queue.pop(2, out), 2u);
  EXPECT_TRUE(queue.try_push(std::move(fourth)));
  EXPECT_EQ(queue.pop(9, out), 2u);
  EXPECT_EQ(queue.pop(9, out), 0u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(*out[static_cast<std::size_t>(i)], i);
  const auto counts = queue.counts();
  EXPECT_EQ(counts.pushed, 4u);
  EXPECT_EQ(counts.popped, 4u);
  EXPECT_EQ(counts.held_back, 1u);
  EXPECT_EQ(counts.most_waiting, 3u);
  EXPECT_THROW(BoundedQueue<int>(0), std::invalid_argument);
}

TEST(BoundedQueue, ThreadsPassEverythingOnInOrder) {
  constexpr int kItems = 20000;
  BoundedQueue<int> queue(16);
  std::thread producer([&] {
    for (int i = 0; i < kItems; ++i) {
      if (!queue.push(int(i))) return;
    }
    queue.close();
  });
  std::vector<int> out;
  while (queue.wait_pop(7, out) > 0) {
  }
  producer.join();
  ASSERT_EQ(out.size(), static_cast<std::size_t>(kItems));
  EXPECT_TRUE(std::is_sorted(out.begin(), out.end()));
  EXPECT_LE(queue.counts().most_waiting, 16u);
  EXPECT_FALSE(queue.push(1));  // closed
  EXPECT_FALSE(queue.try_push(1));
}

TEST(BoundedQueue, ClosingFreesAProducerThatWaits) {
  BoundedQueue<int> queue(1);
  EXPECT_TRUE(queue.push(1));
  bool pushed = true;
  std::thread producer([&] { pushed = queue.push(2); });
  while (queue.counts().held_back == 0) std::this_thread::yield();
  queue.close();
  producer.join();
  EXPECT_FALSE(pushed);
  std::vector<int> out;
  EXPECT_EQ(queue.wait_pop(5, out), 1u);
  EXPECT_EQ(queue.wait_pop(5, out), 0u);
}

TEST(Percentiles, AreNearestRanks) {
  std::mt19937 random(3);
  for (const std::size_t n : {1u, 2u, 3u, 19u, 20u, 99u, 100u, 101u, 250u}) {
    std::vector<double> values(n);
    for (double& v : values) v = static_cast<double>(random() % 1000);
    const Spread s = spread_of(values);
    for (const auto& [percent, value] : {std::pair{50, s.p50}, {95, s.p95}, {99, s.p99}}) {
      // The smallest of the values that at least p % of them do not exceed.
      double expected = 1e9;
      for (const double v : values) {
        const auto not_above = std::count_if(values.begin(), values.end(), [&](double w) { return w <= v; });
        if (100 * static_cast<std::size_t>(not_above) >= static_cast<std::size_t>(percent) * n)
          expected = std::min(expected, v);
      }
      EXPECT_EQ(value, expected) << percent << " of " << n;
      std::sort(values.begin(), values.end());
      EXPECT_EQ(value, values[n - 1 - allowed_above(percent, n)]);
    }
    EXPECT_EQ(s.max, *std::max_element(values.begin(), values.end()));
  }
  EXPECT_EQ(allowed_above(99, 100), 1u);
  EXPECT_EQ(allowed_above(99, 99), 0u);
  EXPECT_EQ(spread_of({}).max, 0);
}

TEST(FindMax, FindsTheLargestFleetOfACostModel) {
  // A cycle of n robots takes 3 + 0.047 n ms; the deadline is 100 ms: 2063 robots.
  const auto p99 = [](std::int64_t n) { return 3 + 0.047 * static_cast<double>(n); };
  for (const std::int64_t start : {1, 2, 100, 2063, 2064, 5000, 1000000}) {
    int trials = 0;
    EXPECT_EQ(find_max({start, 10000000, 0}, [&](std::int64_t n) { return ++trials, p99(n) < 100; }), 2063) << start;
    EXPECT_LT(trials, 40);
    const std::int64_t near = find_max({start, 10000000, 0.02}, [&](std::int64_t n) { return p99(n) < 100; });
    EXPECT_LE(near, 2063);
    EXPECT_GE(static_cast<double>(near), 2063 / 1.03);
  }
  EXPECT_EQ(find_max({10, 500, 0}, [&](std::int64_t n) { return p99(n) < 100; }), 500);
  EXPECT_EQ(find_max({700, 500, 0}, [&](std::int64_t n) { return p99(n) < 100; }), 500);
  EXPECT_EQ(find_max({64, 500, 0}, [](std::int64_t) { return false; }), 0);
  EXPECT_EQ(find_max({64, 500, 0}, [](std::int64_t n) { return n == 1; }), 1);
  EXPECT_EQ(find_max({1, 1, 0}, [](std::int64_t) { return true; }), 1);
}

TEST(Chart, TicksAreRoundAndCover) {
  EXPECT_EQ(round_ticks(100, 6), (std::vector<double>{0, 20, 40, 60, 80, 100}));
  EXPECT_EQ(round_ticks(101, 6).back(), 120);
  EXPECT_EQ(round_ticks(0, 5).front(), 0);
  for (const double top : {1e-3, 0.7, 1.0, 3.0, 99.0, 12345.0, 5e8}) {
    const auto ticks = round_ticks(top, 6);
    EXPECT_GE(ticks.back(), top * (1 - 1e-9));
    EXPECT_LE(ticks.size(), 8u) << top;
    EXPECT_GE(ticks.size(), 3u) << top;
  }
}

TEST(CostTiles, HoldWhatTheMapWouldRender) {
  FakeFleet fleet(fake_map("tbb", 2));
  CostTiles costs(200, 100);
  std::uint64_t tiles = 0;
  for (int i = 0; i < 5; ++i) {
    std::vector<FleetScan> scans(24);
    fleet.drive(static_cast<std::uint64_t>(24 * i), scans);
    fleet.cast(scans);
    if (i == 3) fleet.map.clear();
    fleet.fuse(scans);
    const auto executor = make_openmp_executor(2);
    tiles += costs.update(fleet.map, *executor).tiles;
    EXPECT_EQ(costs.update(fleet.map, *executor).tiles, 0u);
    for (std::int64_t y = -100; y < 300; ++y)
      for (std::int64_t x = -100; x < 300; ++x)
        ASSERT_EQ(costs.at(x, y), cost_of(Costmap{}, fleet.map.mass({x, y}))) << x << ' ' << y << ' ' << i;
  }
  EXPECT_GT(tiles, 0u);
  EXPECT_EQ(costs.at(100000, 0), 255);
  costs.for_each([&](CellIndex at, const std::uint8_t* bytes) {
    for (std::int64_t i = 0; i < CostTiles::kSide * CostTiles::kSide; ++i)
      ASSERT_EQ(bytes[i], costs.at(at.x + i % CostTiles::kSide, at.y + i / CostTiles::kSide)) << i;
  });
}

TEST(CostTiles, AnExtentCostsNothing) { EXPECT_LT(CostTiles(1 << 20, 320).memory_bytes(), 1000u); }

TEST(FleetOptions, BadOnesAreNamed) {
  const auto why = [](auto change) -> std::string {
    FleetOptions o;
    change(o);
    try {
      (void)plan_fleet(o);
      (void)parse_sweeps(o.sweeps);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why([](FleetOptions&) {}), "");
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.robots = 0; }), "--robots: 0 is not within [1,"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.grid = 1; }), "--grid: 1"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.deadline_ms = -1; }), "--deadline-ms: -1"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.deadline_ms = std::numeric_limits<double>::quiet_NaN(); }),
                       "--deadline-ms"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.cell_m = 0; }), "--cell"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.policy = "drop"; }),
                       "--policy: 'drop' is unknown; known: none, backlog, skip"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.policy = "skip"; }), "--log FILE or -o DIR"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.policy = "backlog", o.find_max = true; }), "--find-max"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.backlog = 5; }), "--backlog"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.robot = "tank"; }), "--robot"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.rule = "disjunctive"; }), "--rule"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.model = "beam"; }), "--model"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.robot = "laser180", o.sensors = 8; }), "--sensors"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.max_range_m = -3; }), "max_range_m"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.sweeps = {"colour=1,2"}; }), "--sweep: 'colour=1,2'"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.sweeps = {"robots=1,x"}; }), "--sweep: 'x' is no value for robots"));
  EXPECT_TRUE(contains(why([](FleetOptions& o) { o.sweeps = {"robots=1.5"}; }), "--sweep: '1.5'"));
}

TEST(FleetOptions, SweepsAndSensors) {
  const auto sweeps = parse_sweeps({"robots=10,20", "cell=0.05,0.1"});
  ASSERT_EQ(sweeps.size(), 2u);
  EXPECT_EQ(sweeps[1].values, (std::vector<double>{0.05, 0.1}));
  const FleetOptions o;
  EXPECT_EQ(with(o, "robots", 20).robots, 20);
  EXPECT_EQ(with(o, "grid", 512).grid, 512);
  EXPECT_EQ(with(o, "cell", 0.1).cell_m, 0.1);
  EXPECT_EQ(with(o, "threads", 2).threads, 2);
  FleetOptions eight;
  eight.sensors = 8;
  const auto sonars = plan_fleet(eight).robot.sonars;
  ASSERT_EQ(sonars.size(), 8u);
  EXPECT_NEAR(sonars[2].T_robot_sensor.y_m, 0.353, 1e-12);  // a quarter turn
  EXPECT_NEAR(sonars[2].T_robot_sensor.x_m, 0, 1e-12);
}

}  // namespace
}  // namespace evigrid::driver
