// SPDX-License-Identifier: Apache-2.0
#include "scan/reach_list.hpp"

#include "scan/footprint.hpp"

namespace evigrid {

void ReachList::list(std::span<Footprint> footprints, std::size_t first, std::size_t end,
                     const kernels::KernelTable& table, TileStore& store, const Admission& admission,
                     std::span<ConeFootprint> cones) {
  reached_.clear();
  cones_.clear();
  wanted_.clear();
  for (std::size_t i = first; i < end; ++i) {
    Footprint& f = footprints[i];
    const auto number = static_cast<std::uint32_t>(i);
    compile(f, table);
    if (f.fan) {
      list_fan(number, *f.fan, table, store, admission);
      continue;
    }
    cones[i] = cones_.find(table, f.cone);
    cones_.each_tile(cones[i], [&](TileIndex at) { reached_.push_back({number, at, store.find(at)}); });
  }
}

void ReachList::list_fan(std::uint32_t footprint, const kernels::Fan& fan, const kernels::KernelTable& table,
                         TileStore& store, const Admission& admission) {
  const CellBox box = fan_box(fan);
  const TileIndex first = tile_of(box.x0, box.y0), last = tile_of(box.x1, box.y1);
  for (std::int64_t y = first.y; y <= last.y; ++y) {
    for (std::int64_t x = first.x; x <= last.x; ++x) {
      const TileIndex at{y, x};
      Tile* const tile = store.find(at);
      if (tile == nullptr && !wanted_.contains(at)) {  // a new tile costs memory: look closer before making one
        if (admission.restricts() && admission.refuses(at)) continue;
        const auto& q = fan.reading;
        table.select_fan(q, static_cast<float>(offset(x, q.i0, q.fx)), static_cast<float>(offset(y, q.j0, q.fy)),
                         fan_micros_);
        if (fan_micros_.empty_count + fan_micros_.edge_count == 0) continue;
        wanted_.insert(at);
      }
      reached_.push_back({footprint, at, tile});
    }
  }
}

}  // namespace evigrid
