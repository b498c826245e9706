// SPDX-License-Identifier: Apache-2.0
// How a batch is shared out: few cones stay with the calling thread, many do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
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

}  // namespace
}  // namespace evigrid
