// SPDX-License-Identifier: Apache-2.0
// Where the tiles of a view are: rows of tiles, shared by all views and changed as a persistent tree is. Making a view
// touches the rows of the tiles that changed since the view before it, and nothing else.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "grid/change_log.hpp"
#include "grid/tile_store.hpp"

namespace evigrid {

struct CatalogTile {
  std::int64_t x;
  const TileBuffer* buffer;
};
struct CatalogRow {
  std::int64_t y = 0;
  std::uint64_t born = 0, last = 0;  // age; version of the last change of any of its tiles
  std::vector<CatalogTile> tiles;    // by x
};
struct Catalog {
  std::uint64_t born = 0;
  std::vector<std::shared_ptr<CatalogRow>> rows;  // by y
  [[nodiscard]] const TileBuffer* find(TileIndex) const noexcept;
};

/// The writer's hand: keeps the newest catalog.
class Cataloguer {
 public:
  /// For a view that is about to be opened; touches what changed since the call before. Strong guarantee: when memory
  /// runs out the next call begins anew.
  std::shared_ptr<const Catalog> bring_up_to_date(TileStore&, const ChangeLog&);

 private:
  void build(TileStore&);
  void update(TileStore&, const ChangeLog&);
  CatalogRow& own_row(const TileAges&, std::int64_t y);
  std::shared_ptr<Catalog> newest_;
  std::uint64_t version_ = 0;  // of the map, then
};

}  // namespace evigrid
