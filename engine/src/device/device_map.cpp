// SPDX-License-Identifier: Apache-2.0
#include "device/device_map.hpp"

#include <algorithm>
#include <cstring>

#include "rule_kernels.hpp"

namespace evigrid {

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

void DeviceMap::list_parts(const Plan& plan) {
  entries_.clear(), parts_.clear(), reaches_.clear();
  for (std::size_t region = 0; region < plan.regions(); ++region) {  // a tile's readings lie in one region, in order
    for (const Reach& r : plan.region(region))
      entries_.push_back({run_of_[r.footprint], r.tile, place_of_[r.footprint]});
  }
  if (runs_.size() == 1) {  // by tile, counted
    std::vector<std::uint32_t>& next = reaches_;
    next.assign(plan.tiles.size() + 1, 0);
    for (const Entry& e : entries_) ++next[e.tile + 1];
    for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    sorted_.resize(entries_.size());
    for (const Entry& e : entries_) sorted_[next[e.tile]++] = e;
    entries_.swap(sorted_);
    reaches_.clear();
  } else {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.run != b.run ? a.run < b.run : a.tile < b.tile; });
  }
  for (std::size_t i = 0; i < entries_.size();) {
    std::size_t end = i;
    const Entry& first = entries_[i];
    for (; end < entries_.size() && entries_[end].run == first.run && entries_[end].tile == first.tile; ++end)
      reaches_.push_back(entries_[end].reading);
    kernels::DeviceRun& run = runs_[first.run];
    if (run.parts == 0) run.first_part = static_cast<std::uint32_t>(parts_.size());
    ++run.parts;
    parts_.push_back({first.tile, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end - i)});
    i = end;
  }
}

void DeviceMap::list_tiles(const Pipeline& p, const Plan& plan) {
  constexpr std::size_t kFew = 1024;
  if (taken_ > 2 * p.store.size() + kFew) {  // tiles that were erased left their room behind
    device_->release();
    taken_ = 0;
    for (auto& [at, tile] : p.store.tiles()) tile.on_device = nullptr;
  }
  tiles_.clear();
  for (const TileWork& w : plan.tiles) {
    Tile& tile = *w.tile;
    const bool current = tile.on_device != nullptr && tile.device_version == tile.buffer->marks.last;
    if (tile.on_device == nullptr) {
      tile.on_device = device_->take(p.store.tile_bytes());
      ++taken_;
    }
    tile.device_version = kNoVersion;  // until the batch has come back
    tiles_.push_back({w.at.x, w.at.y, tile.on_device, current ? nullptr : tile.cells});
  }
}

void DeviceMap::take_back(const Pipeline& p, Plan& plan, const kernels::DeviceResult& result) {
  constexpr std::size_t kPiece = 256;
  updated_.clear();
  for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
    if (result.reached[i] != 0) {
      updated_.push_back(i);
    } else {
      plan.tiles[i].tile->device_version = plan.tiles[i].tile->buffer->marks.last;
    }
  }
  struct Piece {
    const std::size_t* updated;
    Plan& plan;
    const float* from;
    std::size_t bytes;
    std::vector<std::uint64_t>& tiles_per_worker;
  };
  for (std::size_t first = 0; first < updated_.size(); first += kPiece) {
    const std::size_t n = std::min(kPiece, updated_.size() - first);
    try {
      device_->arrived(first + n);
    } catch (const kernels::DeviceError& lost) {
      throw std::runtime_error(
          std::string("the device was lost while the map's tiles came back, the map is not whole: ") + lost.what());
    }
    Piece piece{updated_.data() + first, plan, result.cells + first * p.store.tile_bytes() / sizeof(float),
                p.store.tile_bytes(), p.tiles_per_worker};
    p.executor.run(
        static_cast<std::int64_t>(n),
        [](void* context, std::int64_t index, int worker) {
          const Piece& c = *static_cast<Piece*>(context);
          const auto i = static_cast<std::size_t>(index);
          ++c.tiles_per_worker[static_cast<std::size_t>(worker)];
          std::memcpy(c.plan.tiles[c.updated[i]].tile->cells, c.from + i * c.bytes / sizeof(float), c.bytes);
        },
        &piece);
  }
  for (const std::size_t i : updated_) {
    TileWork& w = plan.tiles[i];
    w.reached = result.reached[i];
    w.touched = true;
    w.tile->buffer->marks.mark(w.reached, p.changes.next());
    w.tile->device_version = w.tile->buffer->marks.last;
  }
}

kernels::Stats DeviceMap::fuse(const Pipeline& p, Scratch& s, const kernels::RuleArgs& args) {
  if (s.footprints.empty() || s.plan.tiles.empty()) return {};
  list_runs(p.params, s);
  list_parts(s.plan);
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
  const kernels::DeviceResult result = device_->fuse(batch);
  take_back(p, s.plan, result);
  return result.stats;
}

}  // namespace evigrid
