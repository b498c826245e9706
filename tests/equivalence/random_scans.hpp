// SPDX-License-Identifier: Apache-2.0
// A ring of sonars and a laser, driven through random and exactly aligned poses. Deterministic.
#pragma once
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid::testing {

struct Drive {
  std::vector<Sensor> sensors;
  std::vector<std::vector<float>> ranges;
  std::vector<std::vector<Reading>> readings;
  std::vector<Scan> scans;
};

/// model: of the sonars; a 181-beam laser rides along.
inline std::unique_ptr<Drive> drive(Model model, int steps, unsigned seed) {
  auto d = std::make_unique<Drive>();
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 8; ++i) {
    Sensor s;
    s.model = model;
    s.aperture_rad = (i % 2 == 0 ? 15 : 30) * M_PI / 180;
    s.T_robot_sensor = {0.25 * std::cos(i * M_PI / 4), 0.25 * std::sin(i * M_PI / 4), i * M_PI / 4};
    s.reliability = i % 3 == 0 ? 1.0 : 0.85;
    d->sensors.push_back(s);
  }
  Sensor laser;
  laser.model = Model::beam;
  laser.beams = 181;
  laser.first_beam_rad = -M_PI / 2;
  laser.beam_step_rad = M_PI / 180;
  laser.max_range_m = 4;
  laser.min_range_m = 0.05;
  laser.reliability = 0.9;
  d->sensors.push_back(laser);
  for (int step = 0; step < steps; ++step) {
    const bool aligned = step % 3 == 0;
    const double yaw = aligned ? (step % 24) * M_PI / 12 : 2 * M_PI * u(rng);
    const Pose2 pose =
        aligned ? Pose2{0.05 * (step % 40) + 0.025, -0.05 * (step % 17), yaw} : Pose2{3 * u(rng), 3 * u(rng), yaw};
    std::vector<Reading> readings;
    for (SensorId i = 0; i < d->sensors.size(); ++i) {
      std::vector<float> r;
      for (int b = 0; b < d->sensors[i].beams; ++b) r.push_back(static_cast<float>(0.2 + 4.5 * u(rng)));
      d->ranges.push_back(std::move(r));
      readings.push_back({i, d->ranges.back()});
    }
    d->readings.push_back(std::move(readings));
    d->scans.push_back({step, pose, d->readings.back()});
  }
  return d;
}

struct Outcome {
  std::uint64_t hash;
  Report report;
  std::string kernel, executor;
};
inline Outcome fuse(const Drive& d, MapParams params, std::shared_ptr<Executor> executor, std::size_t batch = 7) {
  Map map(params, std::move(executor));
  for (const auto& s : d.sensors) map.add(s);
  Outcome o;
  for (std::size_t i = 0; i < d.scans.size(); i += batch) {
    o.report += map.integrate(std::span(d.scans).subspan(i, std::min(batch, d.scans.size() - i)));
  }
  o.hash = map.hash();
  o.kernel = map.kernel_name();
  o.executor = map.executor_name();
  return o;
}

}  // namespace evigrid::testing
