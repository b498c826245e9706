// SPDX-License-Identifier: Apache-2.0
// Ways by trial: from where it stands a robot draws goals around it, keeps those it can drive to in a straight line,
// and takes the one that leads farthest, ahead rather than back. That finds its way through doors without a plan of the
// building, and costs a few microseconds when a goal is reached.
#include "evigrid/scenes/fleet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "evigrid/scenes/simulate.hpp"
#include "hearing.hpp"
#include "reading.hpp"

namespace evigrid::scenes {
namespace {

using raycast::Point;

constexpr int kPlaceTries = 1000;  // a building is free over more than half of its area
constexpr int kGoals = 48;         // drawn at every goal reached
constexpr double kNearest_m = 0.3, kFarthest_m = 10;
constexpr std::size_t kBlock = 8;  // scans, or robots, a task

/// Draws of one robot: 0, 1, … of its place, then of its n-th way.
class Chance {
 public:
  Chance(std::uint64_t seed, std::size_t robot, std::uint64_t way)
      : key_{seed, static_cast<std::uint32_t>(robot), kSensor, way} {}
  double between(double low, double high) {
    const std::uint64_t bits = raycast::random_bits(key_, draw_++) >> 11;
    return low + (high - low) * static_cast<double>(bits) * 0x1p-53;
  }

 private:
  static constexpr std::uint32_t kSensor = 0xffffffffu;  // no sensor's noise has this key
  raycast::NoiseKey key_;
  std::uint32_t draw_ = 0;
};

std::size_t blocks(std::size_t count) { return (count + kBlock - 1) / kBlock; }

}  // namespace

struct Fleet::Impl {
  struct Robot {
    Route route;  // to the goal it is driving to
    double begin_s = 0;
    std::uint64_t way = 0;
  };

  [[nodiscard]] Point place(std::size_t robot) const {
    Chance chance(spec.seed, robot, 0);
    const Point low = floor->low(), high = floor->high();
    for (int i = 0; i < kPlaceTries; ++i) {
      const double x_m = chance.between(low.x_m, high.x_m), y_m = chance.between(low.y_m, high.y_m);
      if (floor->stands({x_m, y_m}, clearance_m)) return {x_m, y_m};
    }
    throw std::invalid_argument("no place for robot " + std::to_string(robot) + " of radius " +
                                std::to_string(scene.radius_m) + " m was found");
  }

  [[nodiscard]] Route way_from(const Pose& from, std::size_t robot, std::uint64_t way) const {
    Chance chance(spec.seed, robot, way);
    TrajectorySpec next;
    next.start = from;
    next.speed_m_s = spec.speed_m_s;
    next.turn_rate_rad_s = spec.turn_rate_rad_s;
    double best = 0;
    for (int i = 0; i < kGoals; ++i) {
      const double turn = chance.between(-std::numbers::pi, std::numbers::pi);
      const double way_m = chance.between(kNearest_m, kFarthest_m), worth = way_m * (1.2 + std::cos(turn));
      const Pose goal = advance({from.x_m, from.y_m, from.yaw_rad + turn}, way_m, 0);
      if (worth <= best || !floor->drives({from.x_m, from.y_m}, {goal.x_m, goal.y_m}, clearance_m)) continue;
      best = worth;
      next.waypoints = {{goal.x_m, goal.y_m}};
    }
    if (next.waypoints.empty()) next.legs = {{1, 0, spec.turn_rate_rad_s}};  // hemmed in: look around, try again
    return Route(next);
  }

  Pose at(std::size_t robot, double time_s) {
    Robot& r = all[robot];
    for (double end_s = r.begin_s + r.route.duration_s(); time_s > end_s; end_s += r.route.duration_s()) {
      r.begin_s = end_s;
      r.route = way_from(r.route.at(r.route.duration_s()), robot, ++r.way);
    }
    return r.route.at(time_s - r.begin_s);
  }

  void measure_block(std::uint64_t first, std::span<const Pose> poses, float* out) const;

  const Floor* floor;
  const raycast::Scene* caster;
  Scene scene;
  FleetSpec spec;
  double clearance_m;
  std::size_t ranges = 0;
  std::vector<Robot> all;
};

Fleet::Fleet(const Floor& floor, const raycast::Scene& caster, Scene robot, const FleetSpec& spec,
             const Parallel& parallel)
    : impl_(new Impl{&floor, &caster, std::move(robot), spec, 0, 0, {}}) {
  Impl& m = *impl_;
  m.clearance_m = m.scene.radius_m + spec.margin_m;
  m.ranges = m.scene.sonars.size();
  for (const LaserSpec& laser : m.scene.lasers) m.ranges += static_cast<std::size_t>(laser.beams);
  m.all.assign(spec.robots, {Route({}), 0, 0});
  std::vector<std::string> wrong(blocks(spec.robots));
  parallel(blocks(spec.robots), [&](std::size_t block) {
    try {
      for (std::size_t i = block * kBlock; i < std::min((block + 1) * kBlock, spec.robots); ++i) {
        const Point p = m.place(i);
        const double yaw = Chance(spec.seed, i, 1).between(-std::numbers::pi, std::numbers::pi);
        m.all[i].way = 2;
        m.all[i].route = m.way_from({p.x_m, p.y_m, yaw}, i, 2);
      }
    } catch (const std::invalid_argument& error) {
      wrong[block] = error.what();
    }
  });
  for (const std::string& why : wrong)
    if (!why.empty()) throw std::invalid_argument(why);
}
Fleet::~Fleet() = default;
Fleet::Fleet(Fleet&&) noexcept = default;
Fleet& Fleet::operator=(Fleet&&) noexcept = default;

std::size_t Fleet::robots() const noexcept { return impl_->all.size(); }
std::size_t Fleet::ranges_per_scan() const noexcept { return impl_->ranges; }
std::int64_t Fleet::stamp_ns(std::uint64_t scan) const noexcept {
  return std::llround(static_cast<double>(scan / robots()) * impl_->spec.period_s * 1e9);
}

void Fleet::drive(std::uint64_t first, std::span<Pose> poses, const Parallel& parallel) {
  const std::size_t n = robots();
  // One robot's scans are n apart: a task takes some robots and all their scans, in order.
  const std::size_t taking_part = std::min(n, poses.size());
  parallel(blocks(taking_part), [&](std::size_t block) {
    for (std::size_t k = block * kBlock; k < std::min((block + 1) * kBlock, taking_part); ++k) {
      for (std::size_t i = k; i < poses.size(); i += n) {
        const std::uint64_t scan = first + i;
        poses[i] = impl_->at(scan % n, static_cast<double>(scan / n) * impl_->spec.period_s);
      }
    }
  });
}

void Fleet::Impl::measure_block(std::uint64_t first, std::span<const Pose> poses, float* out) const {
  std::vector<raycast::ConeQuery> cones;
  std::vector<raycast::FanQuery> fans;
  cones.reserve(poses.size() * scene.sonars.size());
  for (const Pose& robot : poses) {
    const double c = std::cos(robot.yaw_rad), s = std::sin(robot.yaw_rad);  // once for all sensors
    const auto mounted = [&](const Pose& mount) {
      return Pose{robot.x_m + c * mount.x_m - s * mount.y_m, robot.y_m + s * mount.x_m + c * mount.y_m,
                  robot.yaw_rad + mount.yaw_rad};
    };
    for (const SonarSpec& sonar : scene.sonars) cones.push_back(query(sonar, mounted(sonar.T_robot_sensor)));
    for (const LaserSpec& laser : scene.lasers) fans.push_back(query(laser, mounted(laser.T_robot_sensor)));
  }
  std::vector<raycast::Echo> echoes(cones.size());
  std::vector<double> beams_m(poses.size() * (ranges - scene.sonars.size()));
  hear(*caster, scene, cones, echoes, {});
  caster->cast_fans(fans, beams_m);

  const raycast::Echo* echo = echoes.data();
  const double* beam_m = beams_m.data();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::uint64_t scan = first + i, step = scan / all.size();
    const auto robot = static_cast<std::uint32_t>(scan % all.size());
    std::uint32_t sensor = 0;
    for (const SonarSpec& sonar : scene.sonars) *out++ = reading(*echo++, sonar, {spec.seed, robot, sensor++, step});
    for (const LaserSpec& laser : scene.lasers) {
      const raycast::NoiseKey key{spec.seed, robot, sensor++, step};
      for (int b = 0; b < laser.beams; ++b)
        *out++ = reading(echo_of(*beam_m++, laser), laser, key, static_cast<std::uint32_t>(b));
    }
  }
}

void Fleet::measure(std::uint64_t first, std::span<const Pose> poses, std::span<float> ranges_m,
                    const Parallel& parallel) const {
  if (ranges_m.size() != poses.size() * impl_->ranges) throw std::invalid_argument("measure: not one place per range");
  parallel(blocks(poses.size()), [&](std::size_t block) {
    const std::size_t begin = block * kBlock, count = std::min(kBlock, poses.size() - begin);
    impl_->measure_block(first + begin, poses.subspan(begin, count), ranges_m.data() + begin * impl_->ranges);
  });
}

}  // namespace evigrid::scenes
