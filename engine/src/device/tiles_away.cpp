// SPDX-License-Identifier: Apache-2.0
// The way back of a device's tiles: cells, and costs instead of cells.
#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <tuple>

#include "device/device_map.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kAtOnce = 2048;  // tiles that pinned memory is needed for
constexpr std::size_t kPiece = 256;    // tiles that are copied while the next ones arrive

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

void DeviceMap::not_whole() const {
  throw std::runtime_error("the device was lost with cells that it alone knew, the map is not whole: " + lost_);
}

void DeviceMap::copy_home(const std::vector<Tile*>& tiles, std::size_t bytes, Executor* executor) {
  if (tiles.empty()) return;
  if (!lost_.empty()) not_whole();
  std::vector<const float*> there;
  for (const Tile* tile : tiles) there.push_back(tile->on_device);
  const std::size_t floats = bytes / sizeof(float);
  for (std::size_t begin = 0; begin < tiles.size(); begin += kAtOnce) {
    const std::size_t all = std::min(kAtOnce, tiles.size() - begin);
    const float* const cells = device_->fetch(std::span(there).subspan(begin, all), floats);
    for (std::size_t first = 0; first < all; first += kPiece) {
      const std::size_t n = std::min(kPiece, all - first);
      device_->arrived(first + n);
      copy_all({tiles.data() + begin + first, cells + first * floats, bytes}, n, executor);
    }
  }
  for (Tile* tile : tiles) tile->away = false;
}

/// Of those listed, once each; all where `part` is null.
std::vector<Tile*> DeviceMap::away_in(TileStore& store, const TileRect* part) const {
  std::vector<Tile*> tiles;
  const auto ask_for = [&](TileIndex at) {
    Tile* const tile = store.find(at);
    if (tile != nullptr && tile->away) tiles.push_back(tile);
  };
  if (part != nullptr && part->tiles() < static_cast<double>(away_.size())) {
    for (TileIndex at = part->first; at.y <= part->last.y; ++at.y) {
      for (at.x = part->first.x; at.x <= part->last.x; ++at.x) ask_for(at);
    }
    return tiles;
  }
  for (const TileIndex at : away_) {
    if (part == nullptr || part->holds(at)) ask_for(at);
  }
  std::sort(tiles.begin(), tiles.end(), std::less<>{});
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  return tiles;
}

void DeviceMap::copy_home(TileStore& store, const TileRect* part, Executor* executor) {
  try {
    copy_home(away_in(store, part), store.tile_bytes(), executor);
  } catch (const kernels::DeviceError& failed) {
    throw std::runtime_error(std::string("cells that the device alone knows do not come home, the map is not whole: ") +
                             failed.what());
  }
  if (part != nullptr) return;
  away_.clear();
  any_away_.store(false, std::memory_order_release);
}

/// Tiles that came home alone or were dropped stay on the list until it is much longer than it need be.
void DeviceMap::tidy(TileStore& store) {
  constexpr std::size_t kFew = 64;
  if (away_.size() <= 2 * store.size() + kFew) return;
  std::erase_if(away_, [&](TileIndex at) {
    const Tile* const tile = store.find(at);
    return tile == nullptr || !tile->away;
  });
  std::sort(away_.begin(), away_.end());
  away_.erase(std::unique(away_.begin(), away_.end()), away_.end());
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
  if (store.layout().render_costs == nullptr || store.layout().age >= 0 || !lost_.empty()) return nullptr;
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
void DeviceMap::render(TileStore& store, RenderedCosts& to) {
  std::vector<Tile*> tiles = away_in(store, nullptr);
  std::erase_if(tiles, [&](const Tile* t) { return to.tiles->holds(t->index, t->device_version); });
  std::vector<const float*> there;
  for (const Tile* tile : tiles) there.push_back(tile->on_device);
  for (std::size_t begin = 0; begin < tiles.size(); begin += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, tiles.size() - begin);
    const std::uint8_t* costs = device_->costs(to.args, std::span(there).subspan(begin, n), store.planes());
    for (std::size_t i = begin; i < begin + n; ++i, costs += TileCosts::kBytes)
      to.tiles->put(tiles[i]->index, tiles[i]->device_version, costs);
  }
}

}  // namespace evigrid
