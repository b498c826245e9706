// SPDX-License-Identifier: Apache-2.0
#include "scan/copy_tiles.hpp"

#include <cstring>

namespace evigrid {
namespace {

struct Copies {
  TileStore& store;
  std::vector<Tile*> tiles;
  std::vector<TileBuffer*> buffers;
  ~Copies() {
    for (TileBuffer* b : buffers) store.drop_buffer(b);
  }
};

}  // namespace

void copy_what_views_see(const Plan& plan, TileStore& store, Executor& executor) {
  if (!store.any_seen()) return;
  Copies copies{store, {}, {}};
  for (const TileWork& w : plan.tiles) {
    if (store.seen(*w.tile)) copies.tiles.push_back(w.tile);
  }
  if (copies.tiles.empty()) return;
  store.reserve(copies.tiles.size());
  copies.buffers.reserve(copies.tiles.size());
  for (std::size_t i = 0; i < copies.tiles.size(); ++i) copies.buffers.push_back(store.make_buffer());
  executor.run(
      static_cast<std::int64_t>(copies.tiles.size()),
      [](void* context, std::int64_t index, int) {
        const auto i = static_cast<std::size_t>(index);
        const Copies& c = *static_cast<Copies*>(context);
        std::memcpy(c.buffers[i]->cells(), c.tiles[i]->cells, c.store.tile_bytes());
        c.buffers[i]->marks = c.tiles[i]->buffer->marks;
      },
      &copies);
  for (std::size_t i = 0; i < copies.tiles.size(); ++i) store.replace(*copies.tiles[i], copies.buffers[i]);
  copies.buffers.clear();
}

}  // namespace evigrid
