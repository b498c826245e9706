// SPDX-License-Identifier: Apache-2.0
#include "scan/bin.hpp"

#include <algorithm>
#include <map>

namespace evigrid {

std::vector<TileWork> bin(const std::vector<Footprint>& footprints, const kernels::KernelTable& table,
                          TileStore& store) {
  std::map<TileIndex, std::vector<std::uint32_t>> lists;
  MicroList micros;
  kernels::FanMicros fan_micros;
  for (std::uint32_t i = 0; i < footprints.size(); ++i) {
    const Footprint& f = footprints[i];
    const CellBox box = footprint_box(f);
    const TileIndex first = tile_of(box.x0, box.y0), last = tile_of(box.x1, box.y1);
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        const TileIndex at{y, x};
        auto list = lists.find(at);
        if (list == lists.end()) {
          // A new tile costs memory: look closer before making one.
          if (f.fan) {
            const auto& q = f.fan->reading;
            table.select_fan(q, static_cast<float>(offset(x, q.i0, q.fx)), static_cast<float>(offset(y, q.j0, q.fy)),
                             fan_micros);
            micros.count = fan_micros.empty_count + fan_micros.edge_count;
          } else {
            select_micros(f.cone, offset(x, f.cone.i0, f.cone.fx), offset(y, f.cone.j0, f.cone.fy), micros);
          }
          if (micros.count == 0) continue;
          list = lists.try_emplace(at).first;
        }
        list->second.push_back(i);
      }
    }
  }
  std::size_t missing = 0;
  for (const auto& [at, list] : lists) missing += store.find(at) == nullptr ? 1 : 0;
  store.reserve(missing);
  std::vector<TileWork> work;
  work.reserve(lists.size());
  for (auto& [at, list] : lists) work.push_back({&store.get_or_make(at), std::move(list)});
  return work;
}

}  // namespace evigrid
