// SPDX-License-Identifier: Apache-2.0
#include "region_task.hpp"

#include <algorithm>

#include "rule_kernels.hpp"

namespace evigrid {
namespace {

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
    const kernels::ConeCuts* const bands = plan.bands(reaches[0].footprint);
    for (const Reach& r : reaches) {
      TileWork& w = plan.tiles[r.tile];
      w.reached |= s_.list.add(b_.p.table, cone, bands, *w.tile, b_.p.store.planes());
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
    s_.decayed.settle(b_.p.store, {stamp_ns, tau_of(own_s, b_.p.params)});
  }

  const Batch& b_;
  RegionScratch& s_;
  int rule_;
  std::int64_t stamp_ns_ = 0;  // of the scan at hand
};

}  // namespace

RegionResult fuse_region(const Batch& batch, RegionScratch& scratch, std::span<const Reach> reaches) {
  RegionTask task(batch, scratch);
  task.run(reaches);
  return {task.stats, task.tiles};
}

}  // namespace evigrid
