// SPDX-License-Identifier: Apache-2.0
#include "scan/bin.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace evigrid {
namespace {

/// A single scan's few readings are not worth waking other threads; more are cut into chunks, some for each thread.
void list_reaches(std::vector<Footprint>& footprints, const kernels::KernelTable& table, TileStore& store,
                  const Admission& admission, Executor& executor, Plan& plan) {
  constexpr std::size_t kAlone = 64, kLeast = 16, kPerThread = 8;
  const std::size_t n = footprints.size();
  const auto threads = static_cast<std::size_t>(executor.concurrency());
  plan.per_list =
      n <= kAlone || threads == 1 ? std::max<std::size_t>(n, 1) : std::max(kLeast, n / (kPerThread * threads));
  plan.lists_used = (n + plan.per_list - 1) / plan.per_list;
  if (plan.lists.size() < plan.lists_used) plan.lists.resize(plan.lists_used);
  plan.cone.resize(n);
  struct All {
    std::vector<Footprint>& footprints;
    const kernels::KernelTable& table;
    TileStore& store;
    const Admission& admission;
    Plan& plan;
    void list(std::size_t number) const {
      const std::size_t first = number * plan.per_list;
      plan.lists[number].list(footprints, first, std::min(first + plan.per_list, footprints.size()), table, store,
                              admission, plan.cone);
    }
  } all{footprints, table, store, admission, plan};
  if (n == 0) return;
  if (plan.lists_used == 1) return all.list(0);
  executor.run(
      static_cast<std::int64_t>(plan.lists_used),
      [](void* context, std::int64_t number, int) {
        static_cast<const All*>(context)->list(static_cast<std::size_t>(number));
      },
      &all);
}

/// Places of tiles in the batch: of those that exist in the tile itself, of the others in a map.
class Places {
 public:
  Places(TileStore& store, const Admission& admission, Missing missing, Plan& plan)
      : store_(store),
        admission_(admission),
        restricted_(admission.restricts()),
        makes_(missing == Missing::made),
        plan_(plan) {}
  static constexpr std::uint32_t kRefused = ~std::uint32_t{0};

  std::uint32_t of(const Reached& r) {
    if (Tile* const tile = r.tile) {
      if (tile->batch != plan_.batch) {
        tile->batch = plan_.batch;
        tile->place = add(r.at, tile);
      }
      return tile->place;
    }
    if (!makes_) return kRefused;
    const auto [it, is_new] = missing_.try_emplace(r.at, kRefused);
    if (is_new) it->second = add(r.at, nullptr);
    return it->second;
  }
  void make_missing() {
    std::erase_if(missing_, [](const auto& m) { return m.second == kRefused; });
    store_.reserve(missing_.size());
    for (const auto& [at, place] : missing_) plan_.tiles[place].tile = &store_.get_or_make(at);
  }

 private:
  std::uint32_t add(TileIndex at, Tile* tile) {
    if (restricted_ && admission_.refuses(at)) return kRefused;
    TileWork w;
    w.at = at;
    w.tile = tile;
    plan_.tiles.push_back(w);
    return static_cast<std::uint32_t>(plan_.tiles.size() - 1);
  }
  TileStore& store_;
  const Admission& admission_;
  bool restricted_, makes_;
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

void bin(std::vector<Footprint>& footprints, const kernels::KernelTable& table, TileStore& store,
         const Admission& admission, Missing missing, Executor& executor, Plan& plan) {
  plan.batch = store.begin_operation();
  plan.tiles.clear();
  plan.unsorted.clear();
  list_reaches(footprints, table, store, admission, executor, plan);
  Places places(store, admission, missing, plan);
  for (const ReachList& list : std::span(plan.lists).first(plan.lists_used)) {
    for (const Reached& r : list.reached()) {
      const std::uint32_t place = places.of(r);
      if (place == Places::kRefused) continue;
      ++plan.tiles[place].readings;
      plan.unsorted.push_back({r.footprint, place});
    }
  }
  places.make_missing();
  const bool fans =
      std::any_of(footprints.begin(), footprints.end(), [](const Footprint& f) { return f.fan != nullptr; });
  share_out(plan, executor.concurrency(), fans);
}

}  // namespace evigrid
