// SPDX-License-Identifier: Apache-2.0
// Arcs of constant velocity against the circle, wheel odometry against closed forms and statistics, movers against
// positions worked out by hand, and what the trajectory and mover tables refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "evigrid/scenes/simulate.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_pose(const Pose& p, double x_m, double y_m, double yaw_rad, double tolerance = 1e-9) {
  EXPECT_NEAR(p.x_m, x_m, tolerance);
  EXPECT_NEAR(p.y_m, y_m, tolerance);
  EXPECT_NEAR(std::remainder(p.yaw_rad - yaw_rad, 2 * kPi), 0, tolerance);
}

TrajectorySpec legs(std::vector<Motion> motions, Pose start, double period_s = 0.1) {
  TrajectorySpec t;
  t.legs = std::move(motions);
  t.start = start;
  t.period_s = period_s;
  return t;
}

TEST(Velocity, AnArcIsAnExactCircle) {
  // 1 m/s and 0.5 rad/s: a circle of 2 m radius around (3, 4) + 2·(−sin, cos)(yaw) = (3, 6), once around in 4π s.
  const auto poses = drive(legs({{4 * kPi, 1, 0.5}}, {3, 4, 0}));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double t = std::min(static_cast<double>(i) * 0.1, 4 * kPi);
    expect_pose(poses[i], 3 + 2 * std::sin(t / 2), 6 - 2 * std::cos(t / 2), t / 2);
  }
  expect_pose(poses.back(), 3, 4, 0);
}

TEST(Velocity, LegsFollowOneAnother) {
  // Ahead, a quarter to the right on a circle of 1 m, a turn on the spot, backwards, standing still.
  const auto poses =
      drive(legs({{2, 0.5, 0}, {1, kPi / 2, -kPi / 2}, {1, 0, kPi}, {3, -0.2, 0}, {1, 0, 0}}, {0, 0, 0}, 1));
  ASSERT_EQ(poses.size(), 9u);
  expect_pose(poses[1], 0.5, 0, 0);
  expect_pose(poses[2], 1, 0, 0);
  expect_pose(poses[3], 2, -1, -kPi / 2);
  expect_pose(poses[4], 2, -1, kPi / 2);
  expect_pose(poses[7], 2, -1.6, kPi / 2);
  expect_pose(poses[8], 2, -1.6, kPi / 2);
}

TEST(Velocity, AlmostStraightIsStraight) {
  expect_pose(advance({0, 0, 0}, 5, 1e-13), 5, 2.5e-13, 1e-13, 1e-15);
  expect_pose(advance({0, 0, 0}, 5, 1e-300), 5, 0, 0, 1e-15);
}

TEST(Waypoints, AStartHeadingIsTurnedFrom) {
  TrajectorySpec t;
  t.start = Pose{0, 0, kPi / 2};
  t.waypoints = {{0, 0}, {1, 0}};
  t.speed_m_s = 1;
  t.turn_rate_rad_s = kPi / 2;
  t.period_s = 0.5;
  const auto poses = drive(t);
  ASSERT_EQ(poses.size(), 5u);
  expect_pose(poses[0], 0, 0, kPi / 2);
  expect_pose(poses[1], 0, 0, kPi / 4);
  expect_pose(poses[3], 0.5, 0, 0);
  expect_pose(poses[4], 1, 0, 0);
}

TrajectorySpec there_and_back() {
  TrajectorySpec t;
  t.waypoints = {{0, 0}, {3.03, 0.4}, {2, 2}, {-1, 1.7}, {0, 0}};
  t.speed_m_s = 0.7;
  t.turn_rate_rad_s = 1.3;
  t.period_s = 0.17;
  return t;
}

TEST(Odometry, WithoutErrorsItIsTheTruth) {
  for (const TrajectorySpec& t :
       {there_and_back(), legs({{3, 1, 0.5}, {1.234, -0.4, -1}, {2, 0, 2}}, {1, 2, 3}, 0.11)}) {
    const auto truth = drive(t), believed = dead_reckoning(t, {.used = true, .track_m = 0.4});
    ASSERT_EQ(truth.size(), believed.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      expect_pose(believed[i], truth[i].x_m, truth[i].y_m, truth[i].yaw_rad, 1e-9);
  }
}

TEST(Odometry, DriftOfOneWheelBendsAStraightWayIntoACircle) {
  // Wheels report v(1 + a) and v(1 + b): speed v(1 + (a + b)/2), turn rate v(b − a)/track: a circle, in closed form.
  const double v = 0.8, a = 0.01, b = -0.02, track = 0.35;
  const auto t = legs({{20, v, 0}}, {1, 2, 0.3});
  const auto believed = dead_reckoning(t, {true, track, a, b, 0});
  const double speed = v * (1 + (a + b) / 2), rate = v * (b - a) / track, radius = speed / rate;
  for (std::size_t i = 0; i < believed.size(); i += 10) {
    const double s = static_cast<double>(i) * 0.1, yaw = 0.3 + rate * s;
    expect_pose(believed[i], 1 + radius * (std::sin(yaw) - std::sin(0.3)), 2 - radius * (std::cos(yaw) - std::cos(0.3)),
                yaw);
  }
}

TEST(Odometry, DriftOnACircleIsAnotherCircle) {
  const double v = 0.5, w = 0.4, a = 0.03, b = 0.01, track = 0.4;
  const auto believed = dead_reckoning(legs({{30, v, w}}, {0, 0, 0}), {true, track, a, b, 0});
  const double left = (v - w * track / 2) * (1 + a), right = (v + w * track / 2) * (1 + b);
  const double speed = (left + right) / 2, rate = (right - left) / track;
  expect_pose(believed.back(), speed / rate * std::sin(rate * 30), speed / rate * (1 - std::cos(rate * 30)), rate * 30);
}

TEST(Odometry, NoiseHasTheStatedSpreadWhateverThePeriod) {
  // 4 m straight: each wheel's way has σ = n·√4; the heading's is √2·n·√4/track, the way's n·√4/√2.
  constexpr int kRuns = 4000;
  const double n = 0.01, track = 0.4;
  for (const double period_s : {0.1, 0.7}) {
    double sum_yaw = 0, sum_yaw2 = 0, sum_x = 0, sum_x2 = 0;
    for (int seed = 0; seed < kRuns; ++seed) {
      TrajectorySpec t = legs({{8, 0.5, 0}}, {0, 0, 0}, period_s);
      t.seed = static_cast<std::uint64_t>(seed);
      const Pose end = dead_reckoning(t, {true, track, 0, 0, n}).back();
      sum_yaw += end.yaw_rad;
      sum_yaw2 += end.yaw_rad * end.yaw_rad;
      sum_x += end.x_m;
      sum_x2 += end.x_m * end.x_m;
    }
    const double sigma_yaw = std::sqrt(2) * n * 2 / track, root = std::sqrt(kRuns);
    EXPECT_NEAR(sum_yaw / kRuns, 0, 4 * sigma_yaw / root);
    EXPECT_NEAR(std::sqrt(sum_yaw2 / kRuns), sigma_yaw, 4 * sigma_yaw / std::sqrt(2 * kRuns));
    // Bending shortens the way by about σ²·L/4 of the heading: below 3 cm here, beside a spread of 1.4 cm.
    EXPECT_NEAR(sum_x / kRuns, 4, 0.03);
    EXPECT_GT(std::sqrt(sum_x2 / kRuns - std::pow(sum_x / kRuns, 2)), 0.9 * n * 2 / std::sqrt(2));
  }
}

TEST(Odometry, RepeatableFromTheSeed) {
  TrajectorySpec t = there_and_back();
  const OdometrySpec noisy{true, 0.3, 0, 0, 0.01};
  const auto first = dead_reckoning(t, noisy), second = dead_reckoning(t, noisy);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].x_m, second[i].x_m);
  t.seed = 1;
  EXPECT_NE(dead_reckoning(t, noisy).back().x_m, first.back().x_m);
  expect_pose(first[0], drive(t)[0].x_m, drive(t)[0].y_m, drive(t)[0].yaw_rad, 0);
}

std::string scene_with(const std::string& more, const std::string& trajectory = "waypoints = [[0, 0], [3, 0]]\n") {
  return "[map]\ncell_m = 0.1\nrule = \"pcr5\"\n[[world.polygons]]\nvertices = [[-5, -5], [5, -5], [5, 5], [-5, 5]]\n"
         "[robot]\nuse = \"ring8\"\n" +
         more + "[trajectory]\nseed = 1\n" + trajectory;
}

std::string complaint(const std::string& text) {
  try {
    (void)parse_scene(text, "s.toml");
  } catch (const SceneError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Movers, StandWhereTheyShould) {
  const Scene s = parse_scene(
      scene_with("[[mover]]\nname = \"person\"\nwaypoints = [[0, 2], [2, 2]]\nspeed_m_s = 1\n[[mover.circles]]\n"
                 "centre = [0, 0]\nradius_m = 0.2\n"
                 "[[mover]]\nwaypoints = [[1, 3], [2, 3], [1, 3]]\nspeed_m_s = 1\nturn_rate_deg_s = 90\nloop = true\n"
                 "[[mover.boxes]]\ncentre = [0, 0]\nlength_m = 0.4\nwidth_m = 0.2\n"
                 "[[mover]]\nstart = [3, 3, 90]\n[[mover.velocity]]\nduration_s = 2\nspeed_m_s = 0.5\n"
                 "turn_rate_deg_s = 45\n[[mover.walls]]\nfrom = [0, 0]\nto = [1, 0]\n",
                 "waypoints = [[0, 0], [3, 0]]\nspeed_m_s = 0.5\nperiod_s = 0.5\n"),
      "s.toml");
  ASSERT_EQ(s.movers.size(), 3u);
  EXPECT_EQ(s.movers[0].name, "person");
  const raycast::Scene caster = make_caster(s);
  const Simulation run(s, caster);
  const auto at = [&](std::size_t step, std::size_t mover) {
    const raycast::Placement p = run.movers_at(step)[mover];
    return Pose{p.x_m, p.y_m, p.yaw_rad};
  };
  expect_pose(at(0, 0), 0, 2, 0);
  expect_pose(at(3, 0), 1.5, 2, 0);
  expect_pose(at(6, 0), 2, 2, 0);  // arrived, stays
  // One way, 2 s of turning, one way: 4 s a round.
  expect_pose(at(1, 1), 1.5, 3, 0);
  expect_pose(at(4, 1), 2, 3, kPi / 2);
  expect_pose(at(7, 1), 1.5, 3, kPi);
  expect_pose(at(9, 1), 1.5, 3, 0);  // the second round
  const double radius = 0.5 / (kPi / 4);
  expect_pose(at(2, 2), 3 - radius * (1 - std::cos(kPi / 4)), 3 + radius * std::sin(kPi / 4), 3 * kPi / 4);
}

TEST(Movers, AreSeenWhereTheyStand) {
  Scene s = parse_scene(scene_with("[[mover]]\nwaypoints = [[2, 2], [2, -2]]\nspeed_m_s = 1\n[[mover.boxes]]\n"
                                   "centre = [0, 0]\nlength_m = 0.4\nwidth_m = 0.4\n",
                                   "start = [0, 0, 0]\n[[trajectory.velocity]]\nduration_s = 4\nspeed_m_s = 0\n"),
                        "s.toml");
  s.sonars.clear();
  LaserSpec laser;
  laser.beams = 1;
  laser.step_rad = 0.1;
  laser.max_range_m = 20;
  s.lasers = {laser};
  const raycast::Scene caster = make_caster(s);
  const auto steps = simulate(s, caster);
  ASSERT_EQ(steps.size(), 41u);
  // The box spans y ± 0.2 around 2 − t: it covers the beam y = 0 for t in [1.8, 2.2].
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool hidden = i > 18 && i < 22;
    if (i != 18 && i != 22) {
      EXPECT_NEAR(steps[i].beams_m[0], hidden ? 1.8 : 5.0, 1e-6) << i;
    }
  }
}

TEST(Trajectory, BadFields) {
  EXPECT_EQ(complaint(scene_with("")), "accepted");
  const std::string leg = "[[trajectory.velocity]]\nduration_s = 2\nspeed_m_s = 1\n";
  EXPECT_EQ(complaint(scene_with("", "start = [0, 0, 90]\n" + leg)), "accepted");
  const std::string box = "[[mover.boxes]]\ncentre = [0, 0]\nlength_m = 1\nwidth_m = 1\n";
  const std::pair<std::string, std::string> matrix[] = {
      {scene_with("", leg), "s.toml:8: trajectory.start: is missing"},
      {scene_with("", "start = [0]\n" + leg), "s.toml:10: trajectory.start: must be [x, y] or [x, y, yaw_deg]"},
      {scene_with("", "start = [0, 0, 400]\n" + leg),
       "s.toml:10: trajectory.start: is 400, must be within [-360, 360]"},
      {scene_with("", "waypoints = [[0, 0]]\n" + leg),
       "s.toml:11: trajectory.velocity: cannot be given beside waypoints"},
      {scene_with("", "kind = \"random\"\n"), "s.toml:10: trajectory.kind: is 'random', must be \"tour\" or left out"},
      {scene_with("", "start = [0, 0]\n[[trajectory.velocity]]\nduration_s = -1\nspeed_m_s = 1\n"),
       "s.toml:12: trajectory.velocity[0].duration_s: is -1, must be within [0, 1e+07]"},
      {scene_with("", "start = [0, 0]\n[[trajectory.velocity]]\nduration_s = 200000\nspeed_m_s = 1\n"),
       "s.toml:11: trajectory.velocity: the run would have more than 1000000 steps"},
      {scene_with("", "start = [0, 0]\n[[trajectory.velocity]]\nduration_s = 2\nsped_m_s = 1\n"),
       "s.toml:11: trajectory.velocity[0].speed_m_s: is missing"},
      {scene_with("", "kind = \"tour\"\nspacing_n = 2\n"),
       "s.toml:11: trajectory.spacing_n: is unknown; did you mean spacing_m?"},
      {scene_with("", "kind = \"tour\"\nwaypoints = [[0, 0]]\n"),
       "s.toml:11: trajectory.waypoints: cannot be given beside a tour"},
      {scene_with("[[mover]]\nwaypoints = [[0, 1]]\n"),
       "s.toml:8: mover[0]: has no shape: neither walls nor boxes, circles or polygons"},
      {scene_with("[[mover]]\n" + box), "s.toml:8: mover[0].waypoints: is missing"},
      {scene_with("[[mover]]\nwaypoints = [[0, 1]]\nloop = 1\n" + box),
       "s.toml:10: mover[0].loop: must be true or false"},
      {scene_with("[[mover]]\nwaypoints = [[0, 1]]\nperiod_s = 1\n" + box),
       "s.toml:10: mover[0].period_s: is unknown"},
      {scene_with("[[mover]]\nwaypoints = [[0, 1]]\n" + box + "material = \"fur\"\n"),
       "s.toml:14: mover[0].boxes[0].material: there is no [material.fur]"},
  };
  for (const auto& [text, message] : matrix) EXPECT_EQ(complaint(text), message) << text;
}

TEST(Trajectory, ATourKeepsItsClearance) {
  const Scene s =
      parse_scene(scene_with("", "kind = \"tour\"\nstart = [0, 0]\nspacing_m = 2\nclearance_m = 0.5\n"), "s.toml");
  ASSERT_GT(s.trajectory.waypoints.size(), 1u);
  EXPECT_EQ(s.trajectory.waypoints[0].x_m, 0);
  for (const Pose& p : drive(s.trajectory)) EXPECT_LT(std::max(std::abs(p.x_m), std::abs(p.y_m)), 4.5 + 0.1);
  EXPECT_EQ(complaint(scene_with("", "kind = \"tour\"\nstart = [4.99, 0]\n")).substr(0, 27),
            "s.toml:11: trajectory.start");
}

}  // namespace
}  // namespace evigrid::scenes
