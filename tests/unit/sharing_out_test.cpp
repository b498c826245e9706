// SPDX-License-Identifier: Apache-2.0
// How a batch is shared out: few cones stay with the calling thread, many do not, and the map is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

/// Runs all by itself and keeps the largest number of tasks of one run.
class Counting final : public Executor {
 public:
  explicit Counting(std::int64_t& most) : most_(most) {}
  [[nodiscard]] int concurrency() const noexcept override { return 4; }
  [[nodiscard]] std::string_view name() const noexcept override { return "counting"; }
  void run(std::int64_t count, Task task, void* context) override {
    most_ = std::max(most_, count);
    for (std::int64_t i = 0; i < count; ++i) task(context, i, static_cast<int>(i % 4));
  }

 private:
  std::int64_t& most_;
};

std::int64_t most_tasks(int cones, double range_m) {
  std::int64_t most = 0;
  Map map({}, std::make_unique<Counting>(most));
  std::vector<Reading> readings;
  const auto range = static_cast<float>(range_m);
  for (int i = 0; i < cones; ++i) {
    Sensor s;
    s.aperture_rad = 0.26;
    s.max_range_m = 5;
    s.T_robot_sensor = {0, 0, 2 * M_PI * i / cones};
    readings.push_back({map.add(s), {&range, 1}});
  }
  EXPECT_GT(map.integrate(Scan{0, {1, 1, 0}, readings}).cells_updated, 0u);
  return most;
}

TEST(SharingOut, FewConesStayWithTheCallingThread) {
  EXPECT_LE(most_tasks(1, 3), 1);
  EXPECT_LE(most_tasks(8, 2), 1);
  EXPECT_GT(most_tasks(24, 3), 1);
  EXPECT_GT(most_tasks(8, 5), 1);  // large ones are not little work
}

/// Plays tasks from the last to the first.
class Backwards final : public Executor {
 public:
  [[nodiscard]] int concurrency() const noexcept override { return 3; }
  [[nodiscard]] std::string_view name() const noexcept override { return "backwards"; }
  void run(std::int64_t count, Task task, void* context) override {
    for (std::int64_t i = count; i-- > 0;) task(context, i, static_cast<int>(i % 3));
  }
};

/// Twelve scans of 24 cones and a fan in one batch, over new ground and old, below zero too, within a window or not.
std::uint64_t fused_by(std::shared_ptr<Executor> executor, std::size_t batch, bool window, Report& report) {
  Map map({}, std::move(executor));
  if (window) map.set_window(CellRect{-64, -64, 128, 192});
  std::vector<SensorId> ids;
  for (int i = 0; i < 25; ++i) {
    Sensor s;
    s.T_robot_sensor = {0.1, 0, 0.26 * i};
    if (i == 24) {
      s.model = Model::beam;
      s.beams = 90;
      s.first_beam_rad = -1.5;
      s.beam_step_rad = 1.0 / 30;
    }
    ids.push_back(map.add(s));
  }
  std::vector<std::vector<float>> ranges;
  std::vector<std::vector<Reading>> readings(12);
  std::vector<Scan> scans;
  for (int scan = 0; scan < 12; ++scan) {
    for (int i = 0; i < 25; ++i)
      ranges.emplace_back(i == 24 ? 90 : 1, 1.0f + 0.15f * static_cast<float>((7 * scan + 3 * i) % 23));
  }
  for (int scan = 0; scan < 12; ++scan) {
    auto& r = readings[static_cast<std::size_t>(scan)];
    for (int i = 0; i < 25; ++i)
      r.push_back({ids[static_cast<std::size_t>(i)], ranges[static_cast<std::size_t>(25 * scan + i)]});
    scans.push_back({scan, {0.8 * scan - 4, 0.3 * scan - 2, 0.5 * scan}, r});
  }
  for (std::size_t i = 0; i < scans.size(); i += batch) report += map.integrate(std::span(scans).subspan(i, batch));
  return map.hash();
}

class SharedOut : public testing::TestWithParam<std::string> {
 protected:
  static std::shared_ptr<Executor> executor() {
    if (GetParam() == "backwards") return std::make_shared<Backwards>();
    return make_executor(GetParam().substr(0, GetParam().size() - 1), GetParam().back() - '0');
  }
};

TEST_P(SharedOut, ManyReadingsAreListedByAllAndGiveTheMapOfSingleScans) {
  for (const bool window : {false, true}) {
    Report one, all;
    const std::uint64_t want = fused_by(make_serial_executor(), 1, window, one);
    EXPECT_EQ(fused_by(executor(), 12, window, all), want);
    EXPECT_EQ(all.cells_updated, one.cells_updated);
    EXPECT_EQ(all.readings_used, 12U * (24U + 90U));
    EXPECT_EQ(all.touched, one.touched);
  }
}

// spin3 is all our own code: under the thread sanitizer TBB's and OpenMP's synchronisation cannot be seen.
INSTANTIATE_TEST_SUITE_P(Executors, SharedOut,
                         testing::Values("serial1", "backwards", "tbb2", "tbb7", "openmp2", "spin3"),
                         [](const auto& who) { return who.param; });

}  // namespace
}  // namespace evigrid
