// SPDX-License-Identifier: Apache-2.0
#include "scan/bin.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "scan/footprint.hpp"

namespace evigrid {
namespace {

/// Places of tiles in the batch: of those that exist in the tile itself, of the others in a map.
class Places {
 public:
  Places(TileStore& store, const Admission& admission, Plan& plan)
      : store_(store), admission_(admission), restricted_(admission.restricts()), plan_(plan) {}
  static constexpr std::uint32_t kNone = ~std::uint32_t{0}, kRefused = kNone - 1;
  [[nodiscard]] static bool is_place(std::uint32_t place) noexcept { return place < kRefused; }

  /// kNone for a tile that neither exists nor has a place.
  std::uint32_t find(TileIndex at) {
    if (Tile* tile = store_.find(at)) {
      if (tile->batch != plan_.batch) {
        tile->batch = plan_.batch;
        tile->place = restricted_ && admission_.refuses(at) ? kRefused : add(at, tile);
      }
      return tile->place;
    }
    if (const auto it = missing_.find(at); it != missing_.end()) return it->second;
    return restricted_ && admission_.refuses(at) ? kRefused : kNone;
  }
  std::uint32_t find_or_add(TileIndex at) {
    const std::uint32_t place = find(at);
    return place != kNone ? place : missing_[at] = add(at, nullptr);
  }
  void make_missing() {
    store_.reserve(missing_.size());
    for (const auto& [at, place] : missing_) plan_.tiles[place].tile = &store_.get_or_make(at);
  }

 private:
  std::uint32_t add(TileIndex at, Tile* tile) {
    TileWork w;
    w.at = at;
    w.tile = tile;
    plan_.tiles.push_back(w);
    return static_cast<std::uint32_t>(plan_.tiles.size() - 1);
  }
  TileStore& store_;
  const Admission& admission_;
  bool restricted_;
  Plan& plan_;
  std::map<TileIndex, std::uint32_t> missing_;
};

/// So little that another thread costs more than it takes over: its cells would have to come from this one's cache.
bool little(const Plan& p) {
  constexpr std::int64_t kAlone = 512;  // micro-tiles, some 30 µs; ten cones of 15 degrees over 3 m
  std::int64_t micros = 0;
  for (const ConeFootprint& f : p.cone) micros += f.micros;
  return micros < kAlone;
}

/// Tiles in row-major order, cut where the readings of their tiles add up to equal shares. A fan is fused tile by tile,
/// so a region of one tile keeps that tile at hand for all its fans; cones are fused over many tiles at once.
void share_out(Plan& p, int threads, bool fans) {
  constexpr std::uint32_t kPerThread = 4;
  const auto tiles = static_cast<std::uint32_t>(p.tiles.size()),
             most = fans                        ? tiles
                    : threads > 1 && !little(p) ? kPerThread * static_cast<std::uint32_t>(threads)
                                                : 1,
             regions = std::min(tiles, most);
  p.region_begin.assign(regions + 1, 0);
  if (regions <= 1) {
    if (regions == 1) p.region_begin[1] = static_cast<std::uint32_t>(p.unsorted.size());
    p.reaches.swap(p.unsorted);
    return;
  }
  p.order.resize(tiles);
  std::iota(p.order.begin(), p.order.end(), 0u);
  std::sort(p.order.begin(), p.order.end(), [&](auto a, auto b) { return p.tiles[a].at < p.tiles[b].at; });
  const std::uint64_t all = p.unsorted.size();
  std::uint64_t before = 0;
  std::uint32_t place = 0;
  for (const std::uint32_t i : p.order) {
    TileWork& w = p.tiles[i];
    w.region = fans ? place++ : static_cast<std::uint32_t>((2 * before + w.readings) * regions / (2 * all));
    before += w.readings;
    p.region_begin[w.region + 1] += w.readings;
  }
  std::partial_sum(p.region_begin.begin(), p.region_begin.end(), p.region_begin.begin());
  p.order.assign(p.region_begin.begin(), p.region_begin.end() - 1);
  p.reaches.resize(p.unsorted.size());
  for (const Reach& r : p.unsorted) p.reaches[p.order[p.tiles[r.tile].region]++] = r;
}

}  // namespace

void bin(const std::vector<Footprint>& footprints, const kernels::KernelTable& table, TileStore& store,
         const Admission& admission, int threads, Plan& plan) {
  plan.batch = store.begin_operation();
  plan.tiles.clear();
  plan.unsorted.clear();
  plan.cones.clear();
  plan.cone.resize(footprints.size());
  Places places(store, admission, plan);
  kernels::FanMicros fan_micros;
  bool fans = false;
  for (std::uint32_t i = 0; i < footprints.size(); ++i) {
    const Footprint& f = footprints[i];
    const auto reach = [&](std::uint32_t place) {
      if (!Places::is_place(place)) return;
      ++plan.tiles[place].readings;
      plan.unsorted.push_back({i, place});
    };
    if (!f.fan) {
      plan.cone[i] = plan.cones.find(table, f.cone);
      plan.cones.each_tile(plan.cone[i], [&](TileIndex at) { reach(places.find_or_add(at)); });
      continue;
    }
    fans = true;
    const CellBox box = fan_box(*f.fan);
    const TileIndex first = tile_of(box.x0, box.y0), last = tile_of(box.x1, box.y1);
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        const TileIndex at{y, x};
        if (const std::uint32_t place = places.find(at); place != Places::kNone) {
          reach(place);
          continue;
        }
        // A new tile costs memory: look closer before making one.
        const auto& q = f.fan->reading;
        table.select_fan(q, static_cast<float>(offset(x, q.i0, q.fx)), static_cast<float>(offset(y, q.j0, q.fy)),
                         fan_micros);
        if (fan_micros.empty_count + fan_micros.edge_count > 0) reach(places.find_or_add(at));
      }
    }
  }
  places.make_missing();
  share_out(plan, threads, fans);
}

}  // namespace evigrid
