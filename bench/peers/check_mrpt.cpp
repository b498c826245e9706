// SPDX-License-Identifier: Apache-2.0
// What MRPT's sonar code does, seen by running it: rows of no time, whose counters and label are the finding. They
// stand beside the speeds, because a cone in the wrong place is cheap at any price.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CObservationRange;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

constexpr double kDeg = M_PI / 180, kCell = 0.05;

CObservationRange sonar(double aperture_rad) {
  CObservationRange o;
  o.minSensorDistance = 0;
  o.maxSensorDistance = 5;
  o.sensorConeApperture = static_cast<float>(aperture_rad);
  return o;
}
void add(CObservationRange& o, double x, double y, double yaw, float range) {
  CObservationRange::TMeasurement m;
  m.sensorPose = {x, y, 0, yaw, 0, 0};
  m.sensedDistance = range;
  o.sensedData.push_back(m);
}
COccupancyGridMap2D empty_room() {
  COccupancyGridMap2D g(-10, 10, -10, 10, kCell);
  g.insertionOptions.maxDistanceInsertion = 5;
  return g;
}
void for_touched(const COccupancyGridMap2D& g, const std::function<void(double x, double y)>& visit) {
  for (unsigned y = 0; y < g.getSizeY(); ++y) {
    for (unsigned x = 0; x < g.getSizeX(); ++x) {
      if (g.getRawMap()[x + y * g.getSizeX()] != 0) visit(g.idx2x(static_cast<int>(x)), g.idx2y(static_cast<int>(y)));
    }
  }
}

/// A 30° cone along x must reach from −15° to 15°.
void cone_direction(benchmark::State& state) {
  double low = 9, high = -9;
  for (auto _ : state) {
    COccupancyGridMap2D g = empty_room();
    CObservationRange o = sonar(30 * kDeg);
    add(o, 0, 0, 0, 4);
    g.insertObservation(o, CPose3D(0, 0, 0, 0, 0, 0));
    for_touched(g, [&](double x, double y) {
      if (std::hypot(x, y) < 1) return;  // near the apex a cell spans many degrees
      low = std::min(low, std::atan2(y, x)), high = std::max(high, std::atan2(y, x));
    });
  }
  state.counters["from_deg"] = low / kDeg;
  state.counters["to_deg"] = high / kDeg;
  state.SetLabel("a sonar of 30 degrees looking along x; right: -15 to 15");
}

/// Two sonars of one robot at 0° and 90° in one observation: cells east and cells north.
void ring_in_one_observation(benchmark::State& state) {
  double east = 0, north = 0;
  for (auto _ : state) {
    COccupancyGridMap2D g = empty_room();
    CObservationRange o = sonar(30 * kDeg);
    add(o, 0, 0, 0, 3);
    add(o, 0, 0, 90 * kDeg, 3);
    g.insertObservation(o, CPose3D(0, 0, 0, 0, 0, 0));
    for_touched(g, [&](double x, double y) { ++(y > x ? north : east); });
  }
  state.counters["cells_east"] = east;
  state.counters["cells_north"] = north;
  state.SetLabel("sonars at 0 and 90 degrees in one observation; right: as many north as east");
}

/// sonarSimulator against a fan of 64 rays stepped by 2 cm through the same grid: cones that hold an obstacle and get
/// 0.
void simulated_zeros(benchmark::State& state) {
  COccupancyGridMap2D world(-5, 55, -5, 55, kCell);
  world.fill(0.99f);
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int box = 0; box < 250; ++box) {  // boxes of 0.3 to 1.5 m, a room's worth of them every few metres
    const double x = 50 * uniform(), y = 50 * uniform(), w = 0.3 + 1.2 * uniform(), h = 0.3 + 1.2 * uniform();
    for (double i = 0; i < w; i += kCell / 2) {
      for (double j = 0; j < h; j += kCell / 2)
        world.setPos(static_cast<float>(x + i), static_cast<float>(y + j), 0.0f);
    }
  }
  double cones = 0, seen = 0, zero_though_seen = 0;
  for (auto _ : state) {
    for (int pose = 0; pose < 200; ++pose) {
      const double X = 2 + 46 * uniform(), Y = 2 + 46 * uniform(), yaw = 2 * M_PI * uniform();
      if (world.getPos(static_cast<float>(X), static_cast<float>(Y)) < 0.5f) continue;  // inside a box
      CObservationRange o = sonar(30 * kDeg);
      for (int k = 0; k < 24; ++k)
        add(o, 0.25 * std::cos(k * 15 * kDeg), 0.25 * std::sin(k * 15 * kDeg), k * 15 * kDeg, 0);
      world.sonarSimulator(o, CPose2D(X, Y, yaw), 0.5f);
      for (int k = 0; k < 24; ++k) {
        const double axis = yaw + k * 15 * kDeg, sx = X + 0.25 * std::cos(axis), sy = Y + 0.25 * std::sin(axis);
        double nearest = 9;
        for (int ray = 0; ray < 64; ++ray) {
          const double a = axis + (-15 + 30 * (ray + 0.5) / 64) * kDeg;
          for (double t = 0; t < std::min(nearest, 4.8); t += 0.02) {
            if (world.getPos(static_cast<float>(sx + t * std::cos(a)), static_cast<float>(sy + t * std::sin(a))) < 0.5f)
              nearest = t;
          }
        }
        if (nearest < 0.05) continue;  // the sensor is inside
        ++cones;
        seen += nearest < 4.8;
        zero_though_seen += nearest < 4.8 && o.sensedData[static_cast<std::size_t>(k)].sensedDistance == 0;
      }
    }
  }
  state.counters["cones"] = cones;
  state.counters["with_obstacle"] = seen;
  state.counters["zero_share"] = zero_though_seen / seen;
  state.SetLabel(
      "sonarSimulator, cones of 30 degrees with an obstacle at 0.05 to 4.8 m that are answered 0; right: none");
}

BENCHMARK(cone_direction)->Name("check/mrpt_cone_direction")->Iterations(1);
BENCHMARK(ring_in_one_observation)->Name("check/mrpt_ring_in_one_observation")->Iterations(1);
BENCHMARK(simulated_zeros)->Name("check/mrpt_sonar_simulator")->Iterations(1);

}  // namespace
