// SPDX-License-Identifier: Apache-2.0
// Sonar rings, evigrid beside MRPT 2.5.8 in one process: 24 cones a scan, the same ranges at the same poses, cells
// counted. One benchmark is one evigrid map (model, rule, kernel) against one MRPT grid; within it MRPT, evigrid on one
// thread, on two, and on two with eight scans a call take turns on slices of 100 scans (alternate.hpp), and the ratios
// are counters of the row. Iterations are rounds; the row's time is evigrid's slice on one thread.
//
//   warm  1024² cells: 200 scans a centimetre apart: the cells are in L2.
//   cold  16384² cells (819 m)²: 1000 scans at random poses, taken in order, the competitors 300 scans apart: between
//   two
//         uses of a cell hundreds of other scans were fused into both maps. What one pass touches is in the label, to
//         be held against the L3 of the machine. MRPT's grid is cleared before each pass, untimed: its cells saturate
//         after a dozen updates, and a saturated map runs without a mispredicted branch, which no robot that sees a
//         place for the first time enjoys.
// Before every turn 20 scans run untimed: in the warm course they bring the cells, in the cold one they lie elsewhere
// and only wake the threads (a TBB worker that has slept for tens of milliseconds comes late).
//
// MRPT counts no cells: each of its readings is inserted alone into a cleared small grid on the same lattice, and the
// cells that it changed are counted; evigrid's are its report's. MRPT gets one observation per sonar (it takes the
// first sensor's pose for all), and a map that is large from the start (it copies the grid when it grows). What it does
// per cell is one saturating addition to an int8, no mass model; its cone is turned by half its aperture.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "bench/peers/alternate.hpp"
#include "evigrid/evigrid.hpp"

namespace {

using namespace evigrid;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CObservationRange;
using mrpt::poses::CPose3D;

constexpr int kSonars = 24;
constexpr double kCell = 0.05, kRingRadius = 0.25, kMaxRange = 5;
constexpr std::size_t kSlice = 100, kWarmUp = 20;

struct Course {
  int side;           ///< cells of the square grid
  std::size_t scans;  ///< of one pass; kWarmUp more follow
  bool cold;
};
constexpr Course kWarm{1024, 200, false}, kCold{16384, 1000, true};
constexpr std::size_t kApart = 3;  ///< slices between two competitors of the cold course

struct RingScan {
  Pose2 pose;
  std::array<float, kSonars> ranges_m;
};
/// The same on every machine: mt19937 is specified bit for bit, and its numbers are scaled by hand.
std::vector<RingScan> ring_scans(const Course& c) {
  std::mt19937 random(99);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double reach = c.side * kCell / 2 - 8;
  std::vector<RingScan> scans(c.scans + kWarmUp);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto step = static_cast<double>(i);
    scans[i].pose = c.cold ? Pose2{(2 * uniform() - 1) * reach, (2 * uniform() - 1) * reach, 0.02 * step}
                           : Pose2{0.01 * step, 0.003 * step, 0.02 * step};
    for (float& r : scans[i].ranges_m) r = static_cast<float>(1 + 3.5 * uniform());
  }
  return scans;
}

Pose2 mount(int i) {
  const double a = 2 * M_PI * i / kSonars;
  return {kRingRadius * std::cos(a), kRingRadius * std::sin(a), a};
}

/// MRPT's side of a course: its grid, its observations, and the cells that each scan changes.
struct MrptRing {
  COccupancyGridMap2D grid;
  std::vector<std::array<CObservationRange, kSonars>> observations;
  std::vector<CPose3D> poses;
  std::vector<std::uint64_t> cells;
  double bytes_touched = 0;  ///< of whole cache lines, by one pass

  static void prepare(COccupancyGridMap2D& g) {
    g.insertionOptions.maxDistanceInsertion = kMaxRange;
    g.insertionOptions.wideningBeamsWithDistance = true;
  }
  MrptRing(const Course& c, double aperture_rad, const std::vector<RingScan>& scans)
      : grid(-c.side * kCell / 2, c.side * kCell / 2, -c.side * kCell / 2, c.side * kCell / 2, kCell) {
    prepare(grid);
    for (const RingScan& s : scans) {
      poses.emplace_back(s.pose.x_m, s.pose.y_m, 0, s.pose.yaw_rad, 0, 0);
      auto& ring = observations.emplace_back();
      for (int i = 0; i < kSonars; ++i) {
        CObservationRange& o = ring[static_cast<std::size_t>(i)];
        o.minSensorDistance = 0;
        o.maxSensorDistance = kMaxRange;
        o.sensorConeApperture = static_cast<float>(aperture_rad);
        CObservationRange::TMeasurement m;
        const Pose2 at = mount(i);
        m.sensorPose = {at.x_m, at.y_m, 0, at.yaw_rad, 0, 0};
        m.sensedDistance = s.ranges_m[static_cast<std::size_t>(i)];
        o.sensedData.push_back(m);
      }
      cells.push_back(count(cells.size()));
    }
    grid.fill(0.5f);
    for (std::size_t i = 0; i < poses.size(); ++i) insert(i);  // first touch
    const auto& raw = grid.getRawMap();
    for (std::size_t line = 0; line + 64 <= raw.size(); line += 64)
      bytes_touched += std::any_of(&raw[line], &raw[line] + 64, [](auto v) { return v != 0; }) ? 64 : 0;
  }
  void insert(std::size_t i) {
    for (const CObservationRange& o : observations[i]) grid.insertObservation(o, poses[i]);
  }
  std::uint64_t count(std::size_t i) const {
    const auto lattice = [](double v) { return std::round(v / kCell) * kCell; };
    const double x = lattice(poses[i].x()), y = lattice(poses[i].y());
    COccupancyGridMap2D alone(x - 8, x + 8, y - 8, y + 8, kCell);
    prepare(alone);
    std::uint64_t n = 0;
    for (const CObservationRange& o : observations[i]) {
      alone.fill(0.5f);
      alone.insertObservation(o, poses[i]);
      const auto& raw = alone.getRawMap();
      n += raw.size() - static_cast<std::uint64_t>(std::count(raw.begin(), raw.end(), 0));
    }
    return n;
  }
};

/// One map, run by one thread or by two: cold maps are too large to keep one each.
struct Switch : Executor {
  std::unique_ptr<Executor> one = make_serial_executor(), two = make_tbb_executor(2);
  int threads = 1;
  int concurrency() const noexcept override { return 2; }
  std::string_view name() const noexcept override { return threads == 1 ? one->name() : two->name(); }
  void run(std::int64_t count, Task task, void* context) override {
    (threads == 1 ? one : two)->run(count, task, context);
  }
};

struct EvigridRing {
  std::shared_ptr<Switch> executor = std::make_shared<Switch>();
  Map map;
  std::vector<std::array<Reading, kSonars>> readings;
  std::vector<Scan> scans;
  EvigridRing(const MapParams& p, Model model, double aperture_rad, const std::vector<RingScan>& ring)
      : map(p, executor), readings(ring.size()) {
    std::array<SensorId, kSonars> ids;
    for (int i = 0; i < kSonars; ++i) {
      Sensor s;
      s.model = model;
      s.aperture_rad = aperture_rad;
      s.max_range_m = kMaxRange;
      s.T_robot_sensor = mount(i);
      ids[static_cast<std::size_t>(i)] = map.add(s);
    }
    for (std::size_t k = 0; k < ring.size(); ++k) {
      for (std::size_t i = 0; i < kSonars; ++i) readings[k][i] = {ids[i], {&ring[k].ranges_m[i], 1}};
      scans.push_back({0, ring[k].pose, readings[k]});
    }
    map.integrate(scans);  // first touch
  }
  std::uint64_t integrate(std::size_t first, std::size_t n, int threads, std::size_t batch) {
    executor->threads = threads;
    std::uint64_t cells = 0;
    for (std::size_t at = first; at < first + n; at += batch)
      cells += map.integrate(std::span<const Scan>(scans).subspan(at, std::min(batch, first + n - at))).cells_updated;
    return cells;
  }
};

/// The last MRPT side is kept: rows of one course follow each other.
MrptRing& mrpt_ring(const Course& c, double aperture_rad, const std::vector<RingScan>& scans) {
  static std::pair<int, double> have{};
  static std::unique_ptr<MrptRing> kept;
  if (have != std::pair(c.side, aperture_rad)) {
    kept.reset();
    kept = std::make_unique<MrptRing>(c, aperture_rad, scans);
    have = {c.side, aperture_rad};
  }
  return *kept;
}

void sonar(benchmark::State& state, Course course, double half_deg, Model model, Rule rule, Kernel kernel,
           bool conflict_plane) {
  if (!kernel_available(kernel)) return state.SkipWithError("this processor cannot run the kernel");
  const double aperture_rad = 2 * half_deg * M_PI / 180;
  const std::vector<RingScan> ring = ring_scans(course);
  MrptRing& mrpt = mrpt_ring(course, aperture_rad, ring);
  EvigridRing ours({.cell_m = kCell, .rule = rule, .kernel = kernel, .keep_conflict = conflict_plane}, model,
                   aperture_rad, ring);
  const std::size_t slices = course.scans / kSlice;
  using Turn = std::function<std::uint64_t(std::size_t first, std::size_t n)>;
  const auto competitor = [&](const char* name, std::size_t shift, const Turn& turn) {
    const auto prepare = [turn, course](std::size_t slice) {
      turn(course.cold ? course.scans : slice * kSlice, kWarmUp);
    };
    return bench::Competitor{name, course.cold ? shift : 0, prepare,
                             [turn](std::size_t slice) { return turn(slice * kSlice, kSlice); }};
  };
  const auto evigrid = [&](int threads, std::size_t batch) {
    return
        [&ours, threads, batch](std::size_t first, std::size_t n) { return ours.integrate(first, n, threads, batch); };
  };
  std::vector<bench::Competitor> all;
  all.push_back(competitor("mrpt", 0, [&mrpt](std::size_t first, std::size_t n) {
    std::uint64_t cells = 0;
    for (std::size_t i = first; i < first + n; ++i) mrpt.insert(i), cells += mrpt.cells[i];
    return cells;
  }));
  if (course.cold) {
    all[0].prepare = [&mrpt, wake = all[0].prepare](std::size_t slice) {
      if (slice == 0) mrpt.grid.fill(0.5f);
      wake(slice);
    };
  }
  all.push_back(competitor("1t", 0, evigrid(1, 1)));
  all.push_back(competitor("2t", kApart, evigrid(2, 1)));
  all.push_back(competitor("2t_batch8", 2 * kApart, evigrid(2, 8)));

  std::size_t round = 0;
  for (auto _ : state) {
    bench::play_round(all, round++, slices);
    state.SetIterationTime(all[1].seconds.back());
  }
  state.counters["rounds"] = static_cast<double>(round);
  for (const bench::Competitor& c : all) {
    state.counters[c.name + "_Mcell/s"] = bench::rate(c) / 1e6;
    state.counters[c.name + "_scans/s"] = static_cast<double>(kSlice) / bench::median(c.seconds);
    if (&c == all.data()) continue;
    state.counters[c.name + "/mrpt_per_cell"] = bench::rate_ratio(c, all[0]);
    state.counters[c.name + "/mrpt_per_scan"] = bench::speed_ratio(c, all[0]);
  }
  state.counters["mrpt_cells/scan"] = bench::median(all[0].cells) / kSlice;
  state.counters["cells/scan"] = bench::median(all[1].cells) / kSlice;
  state.counters["2t/1t"] = bench::speed_ratio(all[2], all[1]);
  char label[200];
  std::snprintf(label, sizeof label, "one pass: MRPT touches %.1f MiB, evigrid's tiles hold %.0f MiB",
                mrpt.bytes_touched / 1048576, static_cast<double>(ours.map.memory_bytes()) / 1048576);
  state.SetLabel(label);
}

void add(const char* course_name, Course course, double half_deg, Model model, Rule rule, Kernel kernel,
         bool conflict) {
  char row[160];
  std::snprintf(row, sizeof row, "sonar/%s/half%g/%s_%s/%s%s", course_name, half_deg, std::string(name(model)).c_str(),
                std::string(name(rule)).c_str(), std::string(name(kernel)).c_str(), conflict ? "/conflict" : "");
  benchmark::RegisterBenchmark(row, sonar, course, half_deg, model, rule, kernel, conflict)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(kernel == Kernel::scalar ? 11 : 41);
}
const bool registered = [] {
  for (const auto& [course_name, course] : {std::pair("warm1024", kWarm), std::pair("cold16384", kCold)}) {
    for (const double half_deg : {7.5, 15.0}) {
      for (const auto& [model, rule] :
           {std::pair(Model::li2014, Rule::pcr5), std::pair(Model::hughes1992, Rule::dempster)}) {
        for (const Kernel kernel : {Kernel::avx512, Kernel::avx2, Kernel::scalar})
          add(course_name, course, half_deg, model, rule, kernel, false);
        add(course_name, course, half_deg, model, rule, Kernel::avx512, true);  // the map's default: also the sum of k
      }
    }
  }
  return true;
}();

}  // namespace
