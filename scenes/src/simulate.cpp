// SPDX-License-Identifier: Apache-2.0
// Steps are measured in blocks: all cones of a block in one call of the caster, as long as nothing moves.
#include "evigrid/scenes/simulate.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "hearing.hpp"
#include "reading.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kBlock = 16;  // steps

}  // namespace

Pose compose(const Pose& a, const Pose& b) noexcept {
  const double c = std::cos(a.yaw_rad), s = std::sin(a.yaw_rad);
  return {a.x_m + c * b.x_m - s * b.y_m, a.y_m + s * b.x_m + c * b.y_m, a.yaw_rad + b.yaw_rad};
}

Simulation::Simulation(Scene scene, const raycast::Scene& caster)
    : scene_(std::move(scene)), poses_(drive(scene_.trajectory)), caster_(&caster) {
  if (scene_.odometry.used) believed_ = dead_reckoning(scene_.trajectory, scene_.odometry);
  for (const MoverSpec& mover : scene_.movers) movers_.emplace_back(mover.trajectory);
}

std::vector<raycast::Placement> Simulation::movers_at(std::size_t i) const {
  std::vector<raycast::Placement> placements;
  for (std::size_t k = 0; k < movers_.size(); ++k) {
    double time_s = static_cast<double>(i) * scene_.trajectory.period_s;
    const double round_s = movers_[k].duration_s();
    if (scene_.movers[k].loop && round_s > 0) time_s = std::fmod(time_s, round_s);
    const Pose p = movers_[k].at(time_s);
    placements.push_back({p.x_m, p.y_m, p.yaw_rad});
  }
  return placements;
}

/// Steps [first, first + count); when something moves, count is 1.
void Simulation::measure(std::size_t first, std::size_t count, Step* steps) const {
  const std::size_t sonars = scene_.sonars.size();
  const std::vector<raycast::Placement> movers = movers_at(first);
  std::vector<raycast::ConeQuery> cones;
  std::vector<raycast::FanQuery> fans;
  std::size_t beams = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    for (const SonarSpec& sonar : scene_.sonars) cones.push_back(query(sonar, compose(poses_[i], sonar.T_robot_sensor)));
    for (const LaserSpec& laser : scene_.lasers) {
      fans.push_back(query(laser, compose(poses_[i], laser.T_robot_sensor)));
      beams += static_cast<std::size_t>(laser.beams);
    }
  }
  std::vector<raycast::Echo> echoes(cones.size());
  std::vector<double> ranges_m(beams);
  hear(*caster_, scene_, cones, echoes, movers);
  caster_->cast_fans(fans, ranges_m, movers);

  const raycast::Echo* echo = echoes.data();
  const double* range_m = ranges_m.data();
  for (std::size_t i = first; i < first + count; ++i) {
    Step& step = *steps++;
    step.stamp_ns = std::llround(static_cast<double>(i) * scene_.trajectory.period_s * 1e9);
    step.T_map_robot = poses_[i];
    step.T_odom_robot = believed_.empty() ? poses_[i] : believed_[i];
    step.ranges_m.reserve(sonars);
    step.beams_m.reserve(beams / count);
    std::uint32_t sensor = 0;
    for (const SonarSpec& sonar : scene_.sonars)
      step.ranges_m.push_back(reading(*echo++, sonar, {scene_.trajectory.seed, 0, sensor++, i}));
    for (const LaserSpec& laser : scene_.lasers) {
      const raycast::NoiseKey key{scene_.trajectory.seed, 0, sensor++, i};
      for (int beam = 0; beam < laser.beams; ++beam)
        step.beams_m.push_back(reading(echo_of(*range_m++, laser), laser, key, static_cast<std::uint32_t>(beam)));
    }
  }
}

Step Simulation::step(std::size_t i) const {
  Step step;
  measure(i, 1, &step);
  return step;
}

std::vector<Step> Simulation::run(std::size_t first, std::size_t count, int threads) const {
  std::vector<Step> steps(count);
  const std::size_t block = movers_.empty() ? kBlock : 1, blocks = (count + block - 1) / block;
  const auto measure_block = [&](std::size_t b) {
    const std::size_t begin = b * block;
    measure(first + begin, std::min(block, count - begin), &steps[begin]);
  };
  // No more than the machine has: TBB would print a warning.
  const int most = tbb::info::default_concurrency(), wanted = threads == 0 ? most : std::min(threads, most);
  if (wanted == 1) {
    for (std::size_t b = 0; b < blocks; ++b) measure_block(b);
  } else {
    tbb::task_arena arena(wanted);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks, measure_block); });
  }
  return steps;
}

raycast::Scene make_caster(const Scene& scene) {
  std::vector<raycast::World> shapes;
  for (const MoverSpec& mover : scene.movers) shapes.push_back(mover.shape);
  return raycast::Scene(scene.world, shapes);
}

std::vector<Step> simulate(const Scene& scene, const raycast::Scene& caster, int threads) {
  const Simulation simulation(scene, caster);
  return simulation.run(0, simulation.steps(), threads);
}

}  // namespace evigrid::scenes
