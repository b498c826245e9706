// SPDX-License-Identifier: Apache-2.0
// Laser scans, evigrid (PCR5) beside MRPT 2.5.8 and OctoMap 1.9.7 in one process: whole logs into an empty map of 5 cm
// cells, competitors taking turns (alternate.hpp), cells counted, maps laid over each other. Iterations are rounds; the
// row's time is evigrid on one thread.
//   1t, 2t     evigrid, 128 scans a call (as `evigrid map` does), on one thread and on two
//   1t_single  evigrid, one scan a call, as the peers are called
// Policies: evigrid and OctoMap change a cell once a scan (OctoMap: hits win), MRPT once a beam. Cells of a peer are
// distinct ones a scan, so its many updates near the sensor count once. What is not the same: evigrid makes its tiles
// within the timed part, OctoMap its nodes, while MRPT's grid lies ready and touched; MRPT adds one int8 a cell,
// OctoMap one float in a node found by a 3-D key, evigrid combines three masses. `thin`: evigrid's wall is as thick as
// a peer's (one cell) instead of its default of 20 cm, so that the maps can be compared cell by cell. OctoMap is slow:
// its rows take every eighth scan, for all competitors.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <functional>
#include <map>

#include "bench/peers/alternate.hpp"
#include "bench/peers/laser_course.hpp"

namespace {

using namespace evigrid;
using bench::LaserCourse;

constexpr std::size_t kBatch = 128;

struct EvigridLaser {
  Sensor fan;
  std::shared_ptr<Executor> executor;
  std::size_t batch;
  std::vector<Reading> readings;
  std::vector<Scan> scans;
  std::unique_ptr<Map> map;
  EvigridLaser(const LaserCourse& c, int threads, std::size_t batch_, bool thin)
      : fan(c.fan),
        executor(threads == 1 ? std::shared_ptr<Executor>(make_serial_executor()) : make_tbb_executor(threads)),
        batch(batch_) {
    if (thin) fan.beam.occupied_half_width_m = fan.beam.empty_margin_m = bench::kCell_m / 2;
    for (std::size_t i = 0; i < c.poses.size(); ++i)
      readings.push_back({0, {c.scan(i), static_cast<std::size_t>(fan.beams)}});
    for (std::size_t i = 0; i < c.poses.size(); ++i)
      scans.push_back({static_cast<std::int64_t>(i), c.poses[i], {&readings[i], 1}});
  }
  void clear() {
    map = std::make_unique<Map>(MapParams{.cell_m = bench::kCell_m, .rule = Rule::pcr5}, executor);
    map->add(fan);
  }
  std::uint64_t run() {
    std::uint64_t cells = 0;
    for (std::size_t at = 0; at < scans.size(); at += batch)
      cells +=
          map->integrate(std::span<const Scan>(scans).subspan(at, std::min(batch, scans.size() - at))).cells_updated;
    return cells;
  }
};

using MakeCourse = std::function<LaserCourse(std::size_t stride)>;
using MakePeer = std::function<std::unique_ptr<bench::LaserPeer>(const LaserCourse&)>;

void laser(benchmark::State& state, const std::string& name, const MakeCourse& make_course, std::size_t stride,
           const MakePeer& make_peer, bool thin) {
  static std::map<std::string, LaserCourse> courses;  // reading and casting take longer than the rows
  const std::string key = name + std::to_string(stride);
  if (!courses.contains(key)) courses[key] = make_course(stride);
  const LaserCourse& course = courses[key];
  const auto peer = make_peer(course);
  const double peer_cells = peer->cells_per_scan() * static_cast<double>(course.poses.size());
  EvigridLaser ours[] = {{course, 1, kBatch, thin}, {course, 2, kBatch, thin}, {course, 1, 1, thin}};
  std::vector<bench::Competitor> all;
  all.push_back({"peer", 0, [&](std::size_t) { peer->clear(); },
                 [&](std::size_t) {
                   for (std::size_t i = 0; i < course.poses.size(); ++i) peer->insert(i);
                   peer->finish();
                   return static_cast<std::uint64_t>(peer_cells);
                 }});
  const char* const names[] = {"1t", "2t", "1t_single"};
  for (int k = 0; k < 3; ++k)
    all.push_back(
        {names[k], 0, [&, k](std::size_t) { ours[k].clear(); }, [&, k](std::size_t) { return ours[k].run(); }});
  std::size_t round = 0;
  for (auto _ : state) {
    bench::play_round(all, round++, 1);
    state.SetIterationTime(all[1].seconds.back());
  }
  const auto scans = static_cast<double>(course.poses.size());
  for (const bench::Competitor& c : all) {
    state.counters[c.name + "_Mcell/s"] = bench::rate(c) / 1e6;
    state.counters[c.name + "_scans/s"] = scans / bench::median(c.seconds);
    if (&c == all.data()) continue;
    state.counters[c.name + "/peer_per_cell"] = bench::rate_ratio(c, all[0]);
    state.counters[c.name + "/peer_per_scan"] = bench::speed_ratio(c, all[0]);
  }
  state.counters["peer_cells/scan"] = peer_cells / scans;
  state.counters["cells/scan"] = bench::median(all[1].cells) / scans;
  state.counters["2t/1t"] = bench::speed_ratio(all[2], all[1]);
  const bench::Agreement a = bench::agreement(*ours[0].map, *peer, course.box);
  state.counters["IoU_free"] = a.iou_free;
  state.counters["IoU_occupied"] = a.iou_occupied;
  state.counters["unknown"] = a.unknown_ours;
  state.counters["peer_unknown"] = a.unknown_peer;
  state.SetLabel(std::to_string(course.poses.size()) + " scans of " + std::to_string(course.fan.beams) +
                 " beams, cut at " + std::to_string(static_cast<int>(course.fan.max_range_m)) + " m");
}

void add(const std::string& name, const MakeCourse& course) {
  struct Row {
    std::string peer;
    MakePeer make;
    std::size_t stride;
    int rounds;
  };
  std::vector<Row> rows;
#ifdef EVIGRID_HAVE_MRPT
  for (const bool widening : {false, true})
    rows.push_back({widening ? "mrpt_widening" : "mrpt",
                    [=](const LaserCourse& c) { return bench::make_mrpt_laser(c, widening); }, 1, 11});
#endif
#ifdef EVIGRID_HAVE_OCTOMAP
  for (const bool lazy : {false, true}) {
    for (const bool discretize : {false, true})
      rows.push_back({std::string("octomap") + (lazy ? "_lazy" : "") + (discretize ? "_discretize" : ""),
                      [=](const LaserCourse& c) { return bench::make_octomap_laser(c, lazy, discretize); }, 8, 3});
  }
#endif
  for (const Row& row : rows) {
    for (const bool thin : {false, true})
      benchmark::RegisterBenchmark(("laser/" + name + "/" + row.peer + (thin ? "/thin" : "")).c_str(),
                                   [=](benchmark::State& s) { laser(s, name, course, row.stride, row.make, thin); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond)
          ->Iterations(row.rounds);
  }
}

const bool registered = [] {
  constexpr std::uint64_t kSeed = 3;
  add("building_seed3", [](std::size_t stride) { return bench::generated(kSeed, stride); });
  const std::filesystem::path logs = std::filesystem::path(EVIGRID_DATA_DIR) / "laser/ple-radish-corrected";
  for (const auto& [name, file, max_range_m] : {std::tuple("intel", "intel-corrected.log.gz", 10.0),
                                                std::tuple("freiburg079", "freiburg-079-corrected.log.gz", 30.0)}) {
    const std::string path = (logs / file).string();
    if (std::filesystem::exists(path))
      add(name, [path, m = max_range_m](std::size_t stride) { return bench::recorded(path, m, stride); });
  }
  return true;
}();

}  // namespace
