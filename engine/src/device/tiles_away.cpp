// SPDX-License-Identifier: Apache-2.0
// The way back of a device's tiles: cells, and costs instead of cells.
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <tuple>

#include "device/device_map.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kAtOnce = 2048;  // tiles that pinned memory is needed for
constexpr std::size_t kPiece = 256;    // tiles that are copied while the next ones arrive

[[noreturn]] void not_whole(const kernels::DeviceError& lost) {
  throw std::runtime_error(std::string("the device was lost with cells that it alone knew, the map is not whole: ") +
                           lost.what());
}

bool same(const kernels::CostArgs& a, const kernels::CostArgs& b) noexcept {
  const auto all = [](const kernels::CostArgs& c) {
    return std::tie(c.free_below, c.lethal_above, c.max_unknown, c.slope, c.none, c.lethal);
  };
  return all(a) == all(b);
}

struct Copy {
  Tile* const* tiles;
  const float* from;
  std::size_t bytes;
  void operator()(std::size_t i) const { std::memcpy(tiles[i]->cells, from + i * bytes / sizeof(float), bytes); }
};

void copy_all(const Copy& copy, std::size_t n, Executor* executor) {
  if (executor == nullptr) {
    for (std::size_t i = 0; i < n; ++i) copy(i);
    return;
  }
  Copy context = copy;
  executor->run(
      static_cast<std::int64_t>(n),
      [](void* c, std::int64_t i, int) { (*static_cast<const Copy*>(c))(static_cast<std::size_t>(i)); }, &context);
}

}  // namespace

void DeviceMap::copy_home(TileStore& store, const TileRect* part, Executor* executor) {
  std::vector<Tile*> tiles;
  std::vector<const float*> there;
  std::vector<TileIndex> still_away;
  for (const TileIndex at : away_) {
    Tile* const tile = store.find(at);
    if (tile == nullptr || !tile->away) continue;  // dropped
    if (part != nullptr && !part->holds(at)) {
      still_away.push_back(at);
      continue;
    }
    tiles.push_back(tile);
    there.push_back(tile->on_device);
  }
  const std::size_t bytes = store.tile_bytes(), floats = bytes / sizeof(float);
  for (std::size_t begin = 0; begin < tiles.size(); begin += kAtOnce) {
    const std::size_t all = std::min(kAtOnce, tiles.size() - begin);
    try {
      const float* const cells = device_->fetch(std::span(there).subspan(begin, all), floats);
      for (std::size_t first = 0; first < all; first += kPiece) {
        const std::size_t n = std::min(kPiece, all - first);
        device_->arrived(first + n);
        copy_all({tiles.data() + begin + first, cells + first * floats, bytes}, n, executor);
      }
    } catch (const kernels::DeviceError& lost) {
      not_whole(lost);
    }
  }
  for (Tile* tile : tiles) tile->away = false;
  away_.swap(still_away);
  any_away_.store(!away_.empty(), std::memory_order_release);
}

void DeviceMap::come_home(TileStore& store, const TileRect* part) {
  if (!any_away()) return;
  const std::lock_guard lock(mutex_);
  copy_home(store, part, nullptr);
}

void DeviceMap::come_home(TileStore& store, Executor& executor) {
  rendered_.clear();
  if (any_away()) copy_home(store, nullptr, &executor);
}

std::shared_ptr<const TileCosts> DeviceMap::costs(TileStore& store, const kernels::CostArgs& args) {
  if (store.layout().render_costs == nullptr || store.layout().age >= 0) return nullptr;
  constexpr std::size_t kConsumers = 4;
  const std::lock_guard lock(mutex_);
  auto of =
      std::find_if(rendered_.begin(), rendered_.end(), [&](const RenderedCosts& r) { return same(r.args, args); });
  if (of == rendered_.end()) {
    if (rendered_.size() == kConsumers) rendered_.erase(rendered_.begin());
    of = rendered_.insert(rendered_.end(), {args, std::make_shared<TileCosts>()});
  }
  if (of->batch != batches_) {
    try {
      render(store, *of);
    } catch (const kernels::DeviceError&) {  // coming home will tell
      return nullptr;
    }
    of->batch = batches_;
  }
  return of->tiles;
}

/// Of what changed since the last time alone.
void DeviceMap::render(const TileStore& store, RenderedCosts& to) {
  std::vector<const Tile*> tiles;
  std::vector<const float*> there;
  for (const TileIndex at : away_) {
    const Tile* const tile = store.find(at);
    if (tile == nullptr || !tile->away || to.tiles->holds(at, tile->device_version)) continue;
    tiles.push_back(tile);
    there.push_back(tile->on_device);
  }
  for (std::size_t begin = 0; begin < tiles.size(); begin += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, tiles.size() - begin);
    const std::uint8_t* costs = device_->costs(to.args, std::span(there).subspan(begin, n), store.planes());
    for (std::size_t i = begin; i < begin + n; ++i, costs += TileCosts::kBytes)
      to.tiles->put(tiles[i]->index, tiles[i]->device_version, costs);
  }
}

}  // namespace evigrid
