// SPDX-License-Identifier: Apache-2.0
// Gate; footprints and binning (scan/bin.hpp); then every region of tiles fuses its readings in their order, regions in
// parallel (owner computes). The order of combination is part of the result, so there are no atomics and no reductions
// on cells, and the map is the same bits for any executor and any number of threads.
#include "integrate.hpp"

#include <algorithm>

#include "device/device_map.hpp"
#include "kernels/row/portable_math.hpp"
#include "region_task.hpp"
#include "scan/copy_tiles.hpp"
#include "scan/gate.hpp"
#include "scan/shield.hpp"
#include "scratch.hpp"

namespace evigrid {
namespace {

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
  return {};
}

/// Every region by its task, regions in parallel.
void fuse_regions(const Pipeline& p, Scratch& s, const kernels::RuleArgs& rule) {
  s.stats.assign(s.plan.regions(), {});
  const auto threads = static_cast<std::size_t>(p.executor.concurrency());
  if (s.workers.size() < threads) s.workers.resize(threads);
  Batch batch{p, s, rule, any_dependent(p)};
  p.executor.run(
      static_cast<std::int64_t>(s.plan.regions()),
      [](void* context, std::int64_t index, int worker) {
        const Batch& b = *static_cast<const Batch*>(context);
        const auto [stats, tiles] = fuse_region(b, b.s.workers[static_cast<std::size_t>(worker)],
                                                b.s.plan.region(static_cast<std::size_t>(index)));
        b.s.stats[static_cast<std::size_t>(index)] = stats;
        b.p.tiles_per_worker[static_cast<std::size_t>(worker)] += tiles;
      },
      &batch);
}

/// What the device alone knows comes home, and the map goes on without it.
void give_up(const Pipeline& p, const kernels::DeviceError& failed) {
  (*p.device)->come_home(p.store, p.executor);
  *p.note = std::string(failed.what()) + "; the map goes on on the processor";
  p.device->reset();
  for (auto& [at, tile] : p.store.tiles()) tile.on_device = nullptr;
}

/// Whether the device is to fuse the batch; if not, all cells are on the host.
bool for_device(const Pipeline& p) {
  if (p.device == nullptr || !*p.device) return false;
  const std::string_view why = not_by_device(p);
  // Protected cells are kept and put back on the host, and cold tiles are written to a file from there.
  const bool host_looks_on = !p.admission.guarded.empty() || p.store.pages();
  if (host_looks_on || !why.empty()) (*p.device)->come_home(p.store, p.executor);
  *p.note = why;
  return why.empty();
}

/// False when the device fails: the map then goes on without it, and says why.
bool fused_by_device(const Pipeline& p, Scratch& s, const kernels::RuleArgs& rule) {
  try {
    s.stats.push_back((*p.device)->fuse(p, s, rule));
  } catch (const kernels::DeviceError& failed) {
    give_up(p, failed);
    return false;
  }
  if (!p.admission.guarded.empty() || p.store.pages()) (*p.device)->come_home(p.store, p.executor);
  return true;
}

}  // namespace

Report integrate(const Pipeline& p, Scratch& s, std::span<const Scan> scans) {
  Report report;
  const std::int64_t before_ns = p.store.now_ns;
  s.footprints.clear();
  std::size_t number = 0;
  s.scan_end.clear();
  for (const Scan& scan : scans) {  // gate: keep what can be used, count the rest
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
  const kernels::RuleArgs rule = args_of(p.params, p.undo);
  s.stats.clear();
  bool by_device = false;
  try {
    const Missing missing = p.undo ? Missing::left_out : Missing::made;  // of what is not there nothing is taken back
    bin(s.footprints, p.table, p.store, p.admission, missing, p.executor, s.plan);
    copy_what_views_see(s.plan, p.store, p.executor);
    if (for_device(p)) {
      const Shield shield(s.plan, p.admission, p.store);
      by_device = fused_by_device(p, s, rule);
    }
  } catch (...) {  // no room: the scans did not come, and tiles that nothing was ever written to need none
    p.store.now_ns = before_ns;
    for (const TileWork& w : s.plan.tiles) {
      if (w.tile != nullptr && w.tile->fresh) p.store.erase(TileIndex(w.at));
    }
    s.plan.tiles.clear();
    throw;
  }
  if (!by_device) {
    const Shield shield(s.plan, p.admission, p.store);
    fuse_regions(p, s, rule);
  }
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
