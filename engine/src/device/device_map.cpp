// SPDX-License-Identifier: Apache-2.0
#include "device/device_map.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "rule_kernels.hpp"

namespace evigrid {

void DeviceMap::forget() noexcept {
  device_->release();
  taken_ = 0;
  away_.clear();
  rendered_.clear();
  lost_.clear();
  any_away_.store(false, std::memory_order_release);
}

void DeviceMap::list_runs(const MapParams& params, const Scratch& s) {
  run_of_.clear(), place_of_.clear(), cones_.clear(), fans_.clear(), runs_.clear();
  cone_ages_.clear(), fan_ages_.clear();
  for (const Footprint& f : s.footprints) {
    const int model = f.fan ? -1 : f.cone_model;
    if (runs_.empty() || runs_.back().model != model) runs_.push_back({model, 0, 0});
    run_of_.push_back(static_cast<std::uint32_t>(runs_.size() - 1));
    if (f.fan) {
      place_of_.push_back(static_cast<std::uint32_t>(fans_.size()));
      fans_.push_back(f.fan.get());
    } else {
      place_of_.push_back(static_cast<std::uint32_t>(cones_.size()));
      cones_.push_back(&f.cone);
    }
    if (params.decay_s <= 0) continue;
    (f.fan ? fan_ages_ : cone_ages_).push_back({f.stamp_ns, tau_of(f.sensor->sensor.decay_s, params)});
  }
}

/// The readings of a region's tiles, tile by tile: a part is what one run has for one tile. A tile's readings lie in
/// one region, in their order.
void DeviceMap::list_region(const Plan& plan, std::size_t region) {
  const std::span<const Reach> all = plan.region(region);
  RegionParts& out = of_region_[region];
  out.parts.clear();
  if (all.empty()) return;
  const auto by_tile = [](const Reach& a, const Reach& b) { return a.tile < b.tile; };
  const auto [lowest, highest] = std::minmax_element(all.begin(), all.end(), by_tile);
  const std::uint32_t first_tile = lowest->tile, tiles = highest->tile - first_tile + 1;
  std::vector<std::uint32_t>& end = out.end_of_tile;
  end.assign(tiles + 1, 0);
  for (const Reach& r : all) ++end[r.tile - first_tile + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::uint32_t* const sorted = reaches_.data() + plan.region_begin[region];
  for (const Reach& r : all) sorted[end[r.tile - first_tile]++] = r.footprint;
  for (std::uint32_t tile = 0, i = 0; tile < tiles; ++tile) {
    while (i < end[tile]) {
      const std::uint32_t run = run_of_[sorted[i]], first = i;
      for (; i < end[tile] && run_of_[sorted[i]] == run; ++i) sorted[i] = place_of_[sorted[i]];
      out.parts.push_back({run, {first_tile + tile, plan.region_begin[region] + first, i - first}});
    }
  }
}

void DeviceMap::list_parts(const Plan& plan, Executor& executor) {
  reaches_.resize(plan.reaches.size());
  if (of_region_.size() < plan.regions()) of_region_.resize(plan.regions());
  struct All {
    DeviceMap& map;
    const Plan& plan;
  } all{*this, plan};
  executor.run(
      static_cast<std::int64_t>(plan.regions()),
      [](void* context, std::int64_t region, int) {
        const All& a = *static_cast<const All*>(context);
        a.map.list_region(a.plan, static_cast<std::size_t>(region));
      },
      &all);
  const std::span<const RegionParts> regions = std::span(of_region_).first(plan.regions());
  for (const RegionParts& r : regions) {
    for (const RegionParts::Part& part : r.parts) ++runs_[part.run].parts;
  }
  std::uint32_t parts = 0;
  for (kernels::DeviceRun& run : runs_) run.first_part = std::exchange(parts, parts + run.parts);
  next_part_.clear();
  for (const kernels::DeviceRun& run : runs_) next_part_.push_back(run.first_part);
  parts_.resize(parts);
  for (const RegionParts& r : regions) {
    for (const RegionParts::Part& part : r.parts) parts_[next_part_[part.run]++] = part.part;
  }
}

void DeviceMap::list_tiles(const Pipeline& p, const Plan& plan) {
  constexpr std::size_t kFew = 1024;
  if (taken_ > 2 * p.store.size() + kFew) {  // tiles that were erased left their room behind
    come_home(p.store, p.executor);
    device_->release();
    taken_ = 0;
    for (auto& [at, tile] : p.store.tiles()) tile.on_device = nullptr;
  }
  tiles_.clear();
  for (const TileWork& w : plan.tiles) {
    Tile& tile = *w.tile;
    const bool current = tile.on_device != nullptr && (tile.away || tile.device_version == tile.buffer->marks.last);
    if (tile.on_device == nullptr) {
      tile.on_device = device_->take(p.store.tile_bytes());
      ++taken_;
    }
    tile.device_version = kNoVersion;  // until the batch is done
    tiles_.push_back({w.at.x, w.at.y, tile.on_device, current ? nullptr : tile.cells});
  }
}

void DeviceMap::mark(const Pipeline& p, Plan& plan, const kernels::DeviceResult& result) {
  tidy(p.store);
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    TileWork& w = plan.tiles[i];
    Tile& tile = *w.tile;
    w.reached = result.reached[i];
    w.touched = w.reached != 0;
    if (w.touched) {
      tile.buffer->marks.mark(w.reached, p.changes.next());
      if (!tile.away) away_.push_back(tile.index);
      tile.away = true;
    }
    tile.device_version = tile.buffer->marks.last;
  }
  any_away_.store(!away_.empty(), std::memory_order_release);
  ++batches_;
}

kernels::Stats DeviceMap::fuse(const Pipeline& p, Scratch& s, const kernels::RuleArgs& args) {
  if (s.footprints.empty() || s.plan.tiles.empty()) return {};
  if (!lost_.empty()) not_whole();
  list_runs(p.params, s);
  list_parts(s.plan, p.executor);
  list_tiles(p, s.plan);
  kernels::DeviceBatch batch;
  batch.rule = kernel_of(p.params.rule);
  batch.planes = p.store.planes();
  batch.conflict_plane = p.params.keep_conflict && !p.undo;
  batch.args = args;
  batch.tiles = tiles_;
  batch.cones = cones_;
  batch.fans = fans_;
  batch.age = p.store.layout().age;
  batch.cone_ages = cone_ages_;
  batch.fan_ages = fan_ages_;
  batch.runs = runs_;
  batch.parts = parts_;
  batch.reaches = reaches_;
  try {
    const kernels::DeviceResult result = device_->fuse(batch);
    mark(p, s.plan, result);
    return result.stats;
  } catch (const kernels::DeviceLost& failed) {
    if (!any_away()) throw;
    lost_ = failed.what();
    not_whole();
  }
}

}  // namespace evigrid
