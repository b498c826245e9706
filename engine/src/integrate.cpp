// SPDX-License-Identifier: Apache-2.0
// Gate, footprints, binning; then every region of tiles fuses its readings in their order, regions in parallel (owner
// computes). The order of combination is part of the result, so there are no atomics and no reductions on cells, and
// the map is the same bits for any executor and any number of threads.
#include "integrate.hpp"

#include <algorithm>

#include "device/device_map.hpp"
#include "kernels/row/portable_math.hpp"
#include "rule_kernels.hpp"
#include "scan/copy_tiles.hpp"
#include "scan/gate.hpp"
#include "scan/shield.hpp"
#include "scratch.hpp"

namespace evigrid {
namespace {

struct Batch {
  const Pipeline& p;
  Scratch& s;
  kernels::RuleArgs rule;
  bool dependent = false;  // some sensor's readings of one scan are no distinct evidence
};

kernels::RuleArgs args_of(const MapParams& p, bool undo) {
  const auto log_odds = [](double q) {
    return static_cast<float>(kernels::portable_log(q) - kernels::portable_log(1 - q));
  };
  kernels::RuleArgs a;
  a.sign = undo ? -1.0f : 1.0f;
  a.unknown_share = p.bayes.likelihood == Likelihood::plp ? 1.0f : 0.5f;
  a.least_log_odds = log_odds(p.bayes.least_p);
  a.most_log_odds = log_odds(p.bayes.most_p);
  a.con = p.keep_con;
  a.last = p.keep_last_conflict;
  return a;
}

/// One region: its readings, in order. Cones are listed ahead of their fusion, so that their cells can be fetched.
class RegionTask {
 public:
  RegionTask(const Batch& b, RegionScratch& scratch) : b_(b), s_(scratch), rule_(kernel_of(b.p.params.rule)) {}

  void run(std::span<const Reach> reaches) {
    for (std::size_t i = 0; i < reaches.size();) {
      std::size_t end = i + 1;
      while (end < reaches.size() && reaches[end].footprint == reaches[i].footprint) ++end;
      const Footprint& f = b_.s.footprints[reaches[i].footprint];
      if (b_.dependent && (i == 0 || f.scan != b_.s.footprints[reaches[i - 1].footprint].scan)) end_scan();
      stamp_ns_ = f.stamp_ns;
      if (f.fan) {
        fuse_cones();
        for (; i < end; ++i) fuse_fan(f, b_.s.plan.tiles[reaches[i].tile]);
      } else {
        list_cone(f, reaches.subspan(i, end - i));
        i = end;
      }
    }
    fuse_cones();
    if (b_.dependent) end_scan();
    for (const Reach& r : reaches) {
      TileWork& w = b_.s.plan.tiles[r.tile];
      if (w.reached == 0 || w.touched) continue;
      ++tiles;
      if (stats.cells == 0) continue;
      w.tile->buffer->marks.mark(w.reached, b_.p.changes.next());
      w.touched = true;
    }
  }
  kernels::Stats stats;
  std::uint64_t tiles = 0;

 private:
  void list_cone(const Footprint& f, std::span<const Reach> reaches) {
    constexpr int kEnough = 4096;
    Plan& plan = b_.s.plan;
    const ConeList::Marks from = s_.list.marks();
    const ConeFootprint& cone = plan.cone[reaches[0].footprint];
    for (const Reach& r : reaches) {
      TileWork& w = plan.tiles[r.tile];
      w.reached |= s_.list.add(cone, plan.cones.bands(cone), *w.tile, b_.p.store.planes());
    }
    s_.pending.push_back({&f, from, s_.list.marks()});
    if (s_.list.size() > kEnough) fuse_cones();
  }
  void fuse_cones() {
    for (const PendingCone& c : s_.pending) {
      kernels::ConeArgs args = s_.list.args(c.from, c.to);
      args.planes = b_.p.store.planes();
      args.conflict_plane = b_.p.params.keep_conflict && !b_.p.undo;
      args.rule = b_.rule;
      if (const Sensor& s = c.footprint->sensor->sensor; s.dependence != Dependence::independent || s.revision) {
        hear_cone(*c.footprint, args);
        continue;
      }
      const auto fuse = [&] { b_.p.table.fuse_cone[rule_][c.footprint->cone_model](args, c.footprint->cone, stats); };
      fuse_forgetting(c.footprint->stamp_ns, c.footprint->sensor->sensor.decay_s, fuse, [&](auto&& hold) {
        for (const kernels::ZoneMicros& zone : args.zone) std::for_each(zone.cells, zone.cells + zone.count, hold);
      });
    }
    s_.pending.clear();
    s_.list.clear();
  }
  void fuse_fan(const Footprint& f, TileWork& w) {
    const kernels::FanReading& q = f.fan->reading;
    kernels::TileArgs args;
    args.cells = w.tile->cells;
    args.planes = b_.p.store.planes();
    args.conflict_plane = b_.p.params.keep_conflict && !b_.p.undo;
    args.rule = b_.rule;
    args.x0 = static_cast<float>(offset(w.at.x, q.i0, q.fx));
    args.y0 = static_cast<float>(offset(w.at.y, q.j0, q.fy));
    kernels::FanMicros& micros = s_.fan_micros;
    b_.p.table.select_fan(q, args.x0, args.y0, micros);
    args.fan = &micros;
    const std::uint64_t before = stats.cells;
    if (f.sensor->sensor.dependence != Dependence::independent) {
      hear_fan(f, args);
    } else {
      fuse_fan_at_once(f, args);
    }
    if (stats.cells == before) return;
    w.reached |= blocks_of(micros.empty, micros.empty_count) | blocks_of(micros.near, micros.near_count) |
                 blocks_of(micros.edge, micros.edge_count - micros.near_count);
  }
  /// Calls visit(number) for each micro-tile of the tile that the fan may touch.
  template <class Visit>
  static void each_micro_of(const kernels::FanMicros& micros, Visit&& visit) {
    const auto each = [&](float micro) { visit(static_cast<std::ptrdiff_t>(micro)); };
    std::for_each(micros.empty, micros.empty + micros.empty_count, each);
    std::for_each(micros.near, micros.near + micros.near_count, each);
    std::for_each(micros.edge, micros.edge + (micros.edge_count - micros.near_count), each);
  }
  void fuse_fan_at_once(const Footprint& f, const kernels::TileArgs& args) {
    const kernels::FanReading& q = f.fan->reading;
    fuse_forgetting(
        f.stamp_ns, f.sensor->sensor.decay_s, [&] { b_.p.table.fuse_fan[rule_](args, q, stats); },
        [&](auto&& hold) {
          each_micro_of(*args.fan,
                        [&](std::ptrdiff_t m) { hold(args.cells + m * kernels::kMicroCells * args.planes); });
        });
  }

  /// Readings that are no distinct evidence: what they say is kept until their scan is over.
  DependentReadings& together(const Sensor& s) {
    return s.dependence == Dependence::independent ? s_.alone : s_.together[static_cast<int>(s.dependence) - 1];
  }
  void hear_cone(const Footprint& f, kernels::ConeArgs args) {
    std::size_t count = 0, at = 0;
    for (const kernels::ZoneMicros& zone : args.zone) count += static_cast<std::size_t>(zone.count);
    if (count == 0) return;
    const Sensor& sensor = f.sensor->sensor;
    const std::vector<Plane>& planes = sensor.revision ? planes_of_revised() : b_.p.store.layout().planes;
    float* const blank = s_.blank.blank(planes, count);
    const auto micro = static_cast<std::ptrdiff_t>(kernels::kMicroCells * planes.size());
    s_.blank_cells.resize(count + kernels::kConeZones * kernels::kConeAhead);
    kernels::ConeArgs heard = args;
    heard.planes = static_cast<int>(planes.size());
    heard.conflict_plane = heard.rule.con = heard.rule.last = false;
    float** listed = s_.blank_cells.data();
    for (kernels::ZoneMicros& zone : heard.zone) {
      zone.cells = listed;
      for (int i = 0; i < zone.count; ++i) *listed++ = blank + static_cast<std::ptrdiff_t>(at++) * micro;
      for (int i = 0; i < kernels::kConeAhead; ++i) *listed++ = blank;
    }
    const int rule = sensor.revision ? static_cast<int>(kernels::kConjunctive) : rule_;
    b_.p.table.fuse_cone[rule][f.cone_model](heard, f.cone, stats);
    if (sensor.revision) s_.revised.revise(sensor, b_.p.params, blank, count);
    DependentReadings& said = together(sensor);
    for (int z = 0; z < kernels::kConeZones; ++z) {
      for (int i = 0; i < args.zone[z].count; ++i) said.add(sensor, args.zone[z].cells[i], heard.zone[z].cells[i]);
    }
    if (sensor.dependence == Dependence::independent && !said.empty()) meet(said, f.stamp_ns, sensor.decay_s);
  }
  void hear_fan(const Footprint& f, const kernels::TileArgs& args) {
    kernels::TileArgs heard = args;
    heard.cells = s_.blank.blank(b_.p.store.layout().planes, kernels::kMicrosPerTile);
    heard.conflict_plane = heard.rule.con = heard.rule.last = false;
    b_.p.table.fuse_fan[rule_](heard, f.fan->reading, stats);
    each_micro_of(*args.fan, [&](std::ptrdiff_t m) {
      const std::ptrdiff_t at = m * kernels::kMicroCells * args.planes;
      together(f.sensor->sensor).add(f.sensor->sensor, args.cells + at, heard.cells + at);
    });
  }
  void end_scan() {
    fuse_cones();
    for (DependentReadings& d : s_.together) {
      if (!d.empty()) meet(d, stamp_ns_, 0);
    }
  }
  void meet(DependentReadings& d, std::int64_t stamp_ns, double own_s) {
    fuse_forgetting(
        stamp_ns, own_s, [&] { d.fuse(b_.p.params, b_.p.store, stats); }, [&](auto&& hold) { d.each_micro(hold); });
  }

  /// One reading. In maps that forget, each micro-tile that it may touch is aged before; `each_micro` calls what it is
  /// given with each of them.
  template <class Fuse, class EachMicro>
  void fuse_forgetting(std::int64_t stamp_ns, double own_s, Fuse&& fuse, EachMicro&& each_micro) {
    if (b_.p.params.decay_s <= 0) return fuse();
    each_micro([&](float* micro) { s_.decayed.hold(micro); });
    s_.decayed.age(b_.p.store, stamp_ns);
    fuse();
    s_.decayed.settle(b_.p.store, {stamp_ns, static_cast<float>(own_s > 0 ? own_s : b_.p.params.decay_s)});
  }

  const Batch& b_;
  RegionScratch& s_;
  int rule_;
  std::int64_t stamp_ns_ = 0;  // of the scan at hand
};

/// Compiling is independent of order. A single scan's few readings are not worth waking other threads.
void compile_all(std::vector<Footprint>& footprints, const Pipeline& p) {
  constexpr std::size_t kChunk = 16, kAlone = 4 * kChunk;
  const std::size_t n = footprints.size();
  if (n <= kAlone) {
    for (Footprint& f : footprints) compile(f, p.table);
    return;
  }
  struct All {
    std::vector<Footprint>& footprints;
    const kernels::KernelTable& table;
  } all_of{footprints, p.table};
  p.executor.run(
      static_cast<std::int64_t>((n + kChunk - 1) / kChunk),
      [](void* context, std::int64_t chunk, int) {
        const auto& [all, table] = *static_cast<All*>(context);
        const std::size_t first = static_cast<std::size_t>(chunk) * kChunk;
        for (std::size_t i = first; i < std::min(first + kChunk, all.size()); ++i) compile(all[i], table);
      },
      &all_of);
}

bool any_dependent(const Pipeline& p) {
  return std::any_of(p.sensors.begin(), p.sensors.end(),
                     [](const CompiledSensor& c) { return c.sensor.dependence != Dependence::independent; });
}

/// What a device's kernels do not do; empty: they do the whole batch.
std::string_view not_by_device(const Pipeline& p) {
  if (any_dependent(p)) return "readings that are no distinct evidence are fused on the processor";
  const auto revised = [](const CompiledSensor& c) { return c.sensor.revision != nullptr; };
  if (std::any_of(p.sensors.begin(), p.sensors.end(), revised))
    return "readings with a learned revision are fused on the processor";
  if (!p.admission.guarded.empty()) return "a map with protected areas is fused on the processor";
  return {};
}

/// Every region by its task, regions in parallel.
void fuse_regions(const Pipeline& p, Scratch& s, const kernels::RuleArgs& rule, int threads) {
  s.stats.assign(s.plan.regions(), {});
  if (s.workers.size() < static_cast<std::size_t>(threads)) s.workers.resize(static_cast<std::size_t>(threads));
  Batch batch{p, s, rule, any_dependent(p)};
  p.executor.run(
      static_cast<std::int64_t>(s.plan.regions()),
      [](void* context, std::int64_t index, int worker) {
        const Batch& b = *static_cast<const Batch*>(context);
        RegionTask task(b, b.s.workers[static_cast<std::size_t>(worker)]);
        task.run(b.s.plan.region(static_cast<std::size_t>(index)));
        b.s.stats[static_cast<std::size_t>(index)] = task.stats;
        b.p.tiles_per_worker[static_cast<std::size_t>(worker)] += task.tiles;
      },
      &batch);
}

/// False where there is no device, and when it fails: the map then goes on without it, and says why.
bool fused_by_device(const Pipeline& p, Scratch& s, const kernels::RuleArgs& rule) {
  if (p.device == nullptr || !*p.device) return false;
  if (const std::string_view why = not_by_device(p); !why.empty()) {
    *p.note = why;
    return false;
  }
  try {
    s.stats.push_back((*p.device)->fuse(p, s, rule));
    p.note->clear();
    return true;
  } catch (const kernels::DeviceError& failed) {
    *p.note = std::string(failed.what()) + "; the map goes on on the processor";
    p.device->reset();
    for (auto& [at, tile] : p.store.tiles()) tile.on_device = nullptr;
    return false;
  }
}

}  // namespace

Report integrate(const Pipeline& p, Scratch& s, std::span<const Scan> scans) {
  Report report;
  s.footprints.clear();
  std::size_t number = 0;
  s.scan_end.clear();
  for (const Scan& scan : scans) {  // gate: compile what can be used, count the rest
    if (!p.undo) {
      std::int64_t& now_ns = p.store.now_ns;
      const bool backwards = scan.stamp_ns < now_ns;
      if (backwards) ++report.stamps_backwards;
      if (!backwards || p.params.decay_s <= 0) now_ns = scan.stamp_ns;  // what is forgotten does not come back
    }
    const std::size_t first = s.footprints.size();
    gate_scan(scan, p.sensors, p.params, s.footprints, report);
    for (std::size_t i = first; i < s.footprints.size(); ++i) s.footprints[i].scan = number;
    ++number;
    s.scan_end.push_back(s.footprints.size());
  }
  compile_all(s.footprints, p);
  const int threads = p.executor.concurrency();
  bin(s.footprints, p.table, p.store, p.admission, threads, s.plan);
  copy_what_views_see(s.plan, p.store, p.executor);
  const Shield shield(s.plan, p.admission, p.store);
  const kernels::RuleArgs rule = args_of(p.params, p.undo);
  s.stats.clear();
  if (!fused_by_device(p, s, rule)) fuse_regions(p, s, rule, threads);
  shield.restore();
  for (const kernels::Stats& region : s.stats) {
    report.cells_updated += region.cells;
    report.total_conflicts += region.total_conflicts;
    report.max_conflict = std::max(report.max_conflict, region.max_conflict);
  }
  for (const TileWork& w : s.plan.tiles) {
    if (!w.touched) continue;
    constexpr std::int64_t kSide = kernels::kTileSide;
    Report one;
    one.touched = {w.at.x * kSide, w.at.y * kSide, kSide, kSide};
    report += one;
    p.changes.moved(*w.tile);
  }
  if (report.cells_updated > 0) p.changes.commit();
  return report;
}

}  // namespace evigrid
