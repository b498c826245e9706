// SPDX-License-Identifier: Apache-2.0
// Gate, footprints, binning; then every tile fuses its readings in their order, tiles in parallel (owner computes). The
// order of combination is part of the result, so there are no atomics and no reductions on cells, and the map is the
// same bits for any executor and any number of threads.
#include "integrate.hpp"

#include <algorithm>

#include "rule_kernels.hpp"
#include "scan/bin.hpp"
#include "scan/footprint.hpp"
#include "scan/gate.hpp"

namespace evigrid {
namespace {

struct Batch {
  const Pipeline& p;
  const std::vector<Footprint>& footprints;
  std::vector<TileWork>& work;
  std::vector<kernels::Stats>& stats;
};

/// One tile: its readings, in order.
void fuse_tile(const Batch& b, std::size_t index) {
  const TileWork& w = b.work[index];
  const int rule = kernel_of(b.p.params.rule);
  MicroList micros;
  kernels::FanMicros fan_micros;
  kernels::TileArgs args;
  args.cells = w.tile->cells.get();
  args.conflict_plane = b.p.params.keep_conflict;
  args.fan = &fan_micros;
  BlockMask reached = 0;
  for (const std::uint32_t i : w.footprints) {
    const Footprint& f = b.footprints[i];
    const auto at = [&](const auto& q) {  // the tile as seen from the sensor
      args.x0 = static_cast<float>(offset(w.tile->index.x, q.i0, q.fx));
      args.y0 = static_cast<float>(offset(w.tile->index.y, q.j0, q.fy));
    };
    if (f.fan) {
      at(f.fan->reading);
      b.p.table.select_fan(f.fan->reading, args.x0, args.y0, fan_micros);
      reached |= blocks_of(fan_micros.empty, fan_micros.empty_count) | blocks_of(fan_micros.near, fan_micros.near_count) |
                 blocks_of(fan_micros.edge, fan_micros.edge_count - fan_micros.near_count);
      b.p.table.fuse_fan[rule](args, f.fan->reading, b.stats[index]);
    } else {
      at(f.cone);
      select_micros(f.cone, args.x0, args.y0, micros);
      args.micros = micros.micro.data();
      args.micro_count = micros.count;
      reached |= blocks_of(args.micros, args.micro_count);
      b.p.table.fuse_cone[rule][f.cone_model](args, f.cone, b.stats[index]);
    }
  }
  if (b.stats[index].cells > 0) w.tile->change->mark(reached, b.p.changes.next());
}

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

}  // namespace

Report integrate(const Pipeline& p, std::span<const Scan> scans) {
  Report report;
  std::vector<Footprint> footprints;
  for (const Scan& scan : scans) {  // gate: compile what can be used, count the rest
    if (scan.stamp_ns < p.last_stamp_ns) ++report.stamps_backwards;
    p.last_stamp_ns = scan.stamp_ns;
    gate_scan(scan, p.sensors, p.params.cell_m, footprints, report);
  }
  compile_all(footprints, p);
  std::vector<TileWork> work = bin(footprints, p.table, p.store);
  std::vector<kernels::Stats> stats(work.size());
  for (const TileWork& w : work) p.changes.enroll(*w.tile);
  Batch batch{p, footprints, work, stats};
  p.executor.run(
      static_cast<std::int64_t>(work.size()),
      [](void* context, std::int64_t index, int worker) {
        const Batch& b = *static_cast<const Batch*>(context);
        fuse_tile(b, static_cast<std::size_t>(index));
        ++b.p.tiles_per_worker[static_cast<std::size_t>(worker)];
      },
      &batch);
  for (std::size_t i = 0; i < work.size(); ++i) {
    Report r;
    r.cells_updated = stats[i].cells;
    r.total_conflicts = stats[i].total_conflicts;
    r.max_conflict = stats[i].max_conflict;
    const TileIndex at = work[i].tile->index;
    if (stats[i].cells > 0) {
      r.touched = {at.x * kernels::kTileSide, at.y * kernels::kTileSide, kernels::kTileSide, kernels::kTileSide};
      p.changes.moved(*work[i].tile->change);
    }
    report += r;
  }
  if (report.cells_updated > 0) p.changes.commit();
  return report;
}

}  // namespace evigrid
