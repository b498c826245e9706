// SPDX-License-Identifier: Apache-2.0
// Casting, evigrid beside a DDA caster over a bitmap (grid_dda.hpp) and MRPT 2.5.8's sonarSimulator and
// laserScanSimulator over the same bitmap of 5 cm cells, taking turns in one process, one thread. Speed is one half of
// it: each counter off_1cm, off_10cm is the share of answers that differ from the exact one by more (no echo counts as
// one at the greatest range), zero the share of cones with something in them that sonarSimulator answers with 0.
// A bitmap puts a wall up to a cell too near, so 1 cm is out of its reach; 10 cm is not.
// Usage: bench_cast_peers --benchmark_min_time=0.5
#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRange.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bench/micro/cast_places.hpp"
#include "bench/peers/alternate.hpp"
#include "bench/peers/grid_dda.hpp"

namespace {

using namespace evigrid;
using namespace evigrid::bench;

constexpr double kRange_m = 5;
constexpr int kPoses = 100, kSonars = 24, kRays = 64, kBeams = 361;

/// What is not asked of a bitmap: materials.
Place plain(int which) {
  Place p = place(which);
  for (auto& x : p.world.walls) x.material = {};
  for (auto& x : p.world.boxes) x.material = {};
  for (auto& x : p.world.circles) x.material = {};
  for (auto& x : p.world.polygons) x.material = {};
  return p;
}

struct Side {
  Place p;
  raycast::Scene scene;
  Bitmap bitmap;
  mrpt::maps::COccupancyGridMap2D grid;
  std::vector<scenes::Pose> poses;

  explicit Side(int which)
      : p(plain(which)),
        scene(p.world),
        bitmap(lines_of(p), p.high.x_m + 2, p.high.y_m + 2),
        grid(0, static_cast<float>(bitmap.columns * bitmap.cell_m), 0, static_cast<float>(bitmap.rows * bitmap.cell_m),
             static_cast<float>(bitmap.cell_m)) {
    grid.fill(1.0f);
    for (int j = 0; j < bitmap.rows; ++j)
      for (int i = 0; i < bitmap.columns; ++i)
        if (bitmap.wall[bitmap.at(i, j)] != 0) grid.setCell(i, j, 0.0f);
    Random r(7);
    for (int i = 0; i < kPoses; ++i)
      poses.push_back({r.uniform(p.low.x_m, p.high.x_m), r.uniform(p.low.y_m, p.high.y_m), r.uniform(-3, 3)});
  }
};

void report_error(benchmark::State& state, const std::string& name, const std::vector<double>& exact_m,
                  const std::vector<double>& got_m) {
  double off_1cm = 0, off_10cm = 0;
  for (std::size_t i = 0; i < exact_m.size(); ++i) {
    off_1cm += std::abs(exact_m[i] - got_m[i]) > 0.01;
    off_10cm += std::abs(exact_m[i] - got_m[i]) > 0.1;
  }
  state.counters[name + "_off_1cm"] = off_1cm / static_cast<double>(exact_m.size());
  state.counters[name + "_off_10cm"] = off_10cm / static_cast<double>(exact_m.size());
}

void report_speed(benchmark::State& state, const std::vector<Competitor>& all) {
  for (const Competitor& c : all) {
    state.counters[c.name + "/s"] = rate(c);
    if (&c != all.data()) state.counters["evigrid/" + c.name] = rate_ratio(all[0], c);
  }
}

double within(double range_m) { return std::min(range_m, kRange_m); }

void cones(benchmark::State& state, int which, double aperture_deg) {
  const Side side(which);
  const double aperture = aperture_deg * std::numbers::pi / 180;
  std::vector<raycast::ConeQuery> queries;
  std::vector<mrpt::obs::CObservationRange> rings(kPoses);
  for (int i = 0; i < kPoses; ++i) {
    const auto& pose = side.poses[static_cast<std::size_t>(i)];
    auto& ring = rings[static_cast<std::size_t>(i)];
    ring.minSensorDistance = 0;
    ring.maxSensorDistance = kRange_m;
    ring.sensorConeApperture = static_cast<float>(aperture);
    for (int k = 0; k < kSonars; ++k) {
      const double bearing = 2 * std::numbers::pi * k / kSonars;
      queries.push_back({pose.x_m, pose.y_m, pose.yaw_rad + bearing, aperture, 0, kRange_m});
      ring.sensedData.emplace_back().sensorPose = {0, 0, 0, bearing, 0, 0};
    }
  }
  Bundle rays;
  for (const auto& q : queries)
    for (int k = 0; k < kRays; ++k) rays.add(q.x_m, q.y_m, q.yaw_rad + q.aperture_rad * (k / (kRays - 1.0) - 0.5));
  std::vector<raycast::Echo> echoes(queries.size());
  std::vector<double> dda_m(queries.size());
  std::vector<Competitor> all;
  const auto add = [&](const char* name, const auto& cast) {
    all.push_back({name, 0, {}, [&, cast](std::size_t) {
                     cast();
                     return std::uint64_t{queries.size()};
                   }});
  };
  add("evigrid", [&] { side.scene.cast_cones(queries, echoes); });
  add("dda_64_rays", [&] {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      float least = kRange_m;
      for (std::size_t k = i * kRays; k < (i + 1) * kRays; ++k)
        least = std::min(least, side.bitmap.cast(rays.x[k], rays.y[k], rays.dx[k], rays.dy[k], kRange_m));
      dda_m[i] = static_cast<double>(least);
    }
  });
  add("mrpt", [&] {
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const auto& p = side.poses[i];
      side.grid.sonarSimulator(rings[i], {p.x_m, p.y_m, p.yaw_rad});
    }
  });
  std::size_t round = 0;
  for (auto _ : state) {
    play_round(all, round++, 1);
    state.SetIterationTime(all[0].seconds.back());
  }
  std::vector<double> exact_m, mrpt_m;
  double zero = 0, there = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    exact_m.push_back(within(echoes[i].range_m));
    mrpt_m.push_back(static_cast<double>(rings[i / kSonars].sensedData[i % kSonars].sensedDistance));
    there += exact_m[i] > 0.05 && exact_m[i] < kRange_m - 0.2;
    zero += exact_m[i] > 0.05 && exact_m[i] < kRange_m - 0.2 && mrpt_m[i] == 0;
  }
  report_speed(state, all);
  report_error(state, "dda", exact_m, dda_m);
  report_error(state, "mrpt", exact_m, mrpt_m);
  state.counters["mrpt_zero"] = zero / there;
  state.SetLabel(side.p.name);
}

void beams(benchmark::State& state, int which) {
  const Side side(which);
  constexpr double kSpan = 2 * std::numbers::pi, kStep = kSpan / (kBeams - 1);
  std::vector<raycast::FanQuery> fans;
  Bundle rays;
  for (const auto& p : side.poses) {
    fans.push_back({p.x_m, p.y_m, p.yaw_rad, -kSpan / 2, kStep, kBeams, kRange_m});
    for (int k = 0; k < kBeams; ++k) rays.add(p.x_m, p.y_m, p.yaw_rad - kSpan / 2 + k * kStep);
  }
  const std::size_t count = rays.x.size();
  std::vector<double> exact_m(count), dda_m(count);
  std::vector<mrpt::obs::CObservation2DRangeScan> scans(kPoses);
  for (auto& s : scans) s.aperture = static_cast<float>(kSpan), s.maxRange = kRange_m, s.rightToLeft = true;
  std::vector<Competitor> all;
  const auto add = [&](const char* name, const auto& cast) {
    all.push_back({name, 0, {}, [&, cast](std::size_t) {
                     cast();
                     return std::uint64_t{count};
                   }});
  };
  add("evigrid", [&] { side.scene.cast_fans(fans, exact_m); });
  add("dda", [&] {
    for (std::size_t k = 0; k < count; ++k)
      dda_m[k] = static_cast<double>(side.bitmap.cast(rays.x[k], rays.y[k], rays.dx[k], rays.dy[k], kRange_m));
  });
  add("mrpt", [&] {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const auto& p = side.poses[i];
      side.grid.laserScanSimulator(scans[i], {p.x_m, p.y_m, p.yaw_rad}, 0.6f, kBeams);
    }
  });
  std::size_t round = 0;
  for (auto _ : state) {
    play_round(all, round++, 1);
    state.SetIterationTime(all[0].seconds.back());
  }
  std::vector<double> mrpt_m;
  for (const auto& s : scans)
    for (std::size_t k = 0; k < kBeams; ++k)
      mrpt_m.push_back(s.getScanRangeValidity(k) ? within(static_cast<double>(s.getScanRange(k))) : kRange_m);
  for (double& e : exact_m) e = within(e);
  report_speed(state, all);
  report_error(state, "dda", exact_m, dda_m);
  report_error(state, "mrpt", exact_m, mrpt_m);
  state.SetLabel(side.p.name);
}

BENCHMARK_CAPTURE(cones, room_15deg, 0, 15.0)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cones, room_30deg, 0, 30.0)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cones, segments_960_15deg, 3, 15.0)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cones, segments_960_30deg, 3, 30.0)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(beams, room, 0)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(beams, segments_960, 3)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
