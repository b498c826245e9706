// SPDX-License-Identifier: Apache-2.0
// Nothing is dropped in silence: every refusal is counted by its reason, and what is refused changes no cell.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();

Sensor sonar() {
  Sensor s;
  s.model = Model::li2014;
  s.min_range_m = 0.2;
  s.max_range_m = 3;
  s.no_return_m = 5;
  return s;
}
Sensor laser(int beams) {
  Sensor s;
  s.model = Model::beam;
  s.beams = beams;
  s.first_beam_rad = -1.5;
  s.beam_step_rad = 3.0 / beams;
  s.min_range_m = 0.1;
  s.max_range_m = 4;
  s.no_return_m = 20;
  return s;
}
std::uint64_t count(const Report& r, Refusal why) { return r.refused[static_cast<std::size_t>(why)]; }

Report one(Map& map, SensorId id, float range, Pose2 pose = {}) {
  const Reading reading{id, {&range, 1}};
  return map.integrate(Scan{0, pose, {&reading, 1}});
}

TEST(Gate, SonarReasons) {
  const struct {
    float range;
    Refusal why;
  } cases[] = {{kNan, Refusal::not_a_number}, {kInf, Refusal::no_return}, {-kInf, Refusal::too_close},
               {-0.5f, Refusal::negative},    {0.1f, Refusal::too_close}, {0.0f, Refusal::too_close},
               {5.0f, Refusal::no_return},    {7.0f, Refusal::no_return}, {3.5f, Refusal::above_max_range},
               {1e30f, Refusal::no_return},   {-1e30f, Refusal::negative}};
  for (const auto& c : cases) {
    Map map({}, make_serial_executor());
    const Report r = one(map, map.add(sonar()), c.range);
    EXPECT_EQ(count(r, c.why), 1u) << c.range;
    EXPECT_EQ(r.refused_total(), 1u) << c.range;
    EXPECT_EQ(r.readings_used, 0u);
    EXPECT_EQ(r.cells_updated, 0u);
    EXPECT_TRUE(map.bounds().empty());
  }
  Map map({}, make_serial_executor());
  const Report r = one(map, map.add(sonar()), 2.0f);
  EXPECT_EQ(r.readings_used, 1u);
  EXPECT_EQ(r.refused_total(), 0u);
  EXPECT_GT(r.cells_updated, 100u);
}

TEST(Gate, PosesSensorsAndBeamCounts) {
  Map map({}, make_serial_executor());
  const SensorId id = map.add(sonar()), fan = map.add(laser(30));
  const double bad[] = {kNan, kInf, -kInf, 1e300};
  for (const double v : bad) {
    EXPECT_EQ(count(one(map, id, 2, {v, 0, 0}), Refusal::pose_not_finite), 1u);
    EXPECT_EQ(count(one(map, id, 2, {0, v, 0}), Refusal::pose_not_finite), 1u);
    EXPECT_EQ(count(one(map, id, 2, {0, 0, v}), Refusal::pose_not_finite), 1u);
  }
  EXPECT_EQ(count(one(map, 17, 2), Refusal::unknown_sensor), 1u);
  EXPECT_EQ(count(one(map, fan, 2), Refusal::wrong_beam_count), 1u);
  EXPECT_TRUE(map.bounds().empty());
}

TEST(Gate, FanCountsEachBeamAndClipsFarOnes) {
  Map map({}, make_serial_executor());
  Sensor s = laser(6);
  const SensorId id = map.add(s);
  const std::vector<float> ranges{2, 10, 25, kNan, -1, kInf};
  const Reading reading{id, ranges};
  const Report r = map.integrate(Scan{0, {}, {&reading, 1}});
  EXPECT_EQ(r.readings_used, 2u);
  EXPECT_EQ(r.readings_clipped, 1u);
  EXPECT_EQ(count(r, Refusal::no_return), 2u);
  EXPECT_EQ(count(r, Refusal::not_a_number), 1u);
  EXPECT_EQ(count(r, Refusal::negative), 1u);

  s.clear_no_return = true;
  Map clearing({}, make_serial_executor());
  const Reading again{clearing.add(s), ranges};
  const Report c = clearing.integrate(Scan{0, {}, {&again, 1}});
  EXPECT_EQ(c.readings_used, 4u);
  EXPECT_EQ(c.readings_clipped, 3u);
  EXPECT_GT(c.cells_updated, r.cells_updated);
}

TEST(Gate, StampsThatRunBackwardsAreUsedAndCounted) {
  Map map({}, make_serial_executor());
  const SensorId id = map.add(sonar());
  const float range = 2;
  const Reading reading{id, {&range, 1}};
  Report r;
  for (const std::int64_t stamp : {10, 20, 15, 30}) r += map.integrate(Scan{stamp, {}, {&reading, 1}});
  EXPECT_EQ(r.stamps_backwards, 1u);
  EXPECT_EQ(r.readings_used, 4u);
}

}  // namespace
}  // namespace evigrid
