// SPDX-License-Identifier: Apache-2.0
#include "grid/tile_catalog.hpp"

#include <algorithm>

namespace evigrid {
namespace {

auto place_of(const std::vector<std::shared_ptr<CatalogRow>>& rows, std::int64_t y) noexcept {
  return std::lower_bound(rows.begin(), rows.end(), y, [](const auto& row, std::int64_t to) { return row->y < to; });
}
template <class Tiles>
auto place_in(Tiles& tiles, std::int64_t x) noexcept {
  return std::lower_bound(tiles.begin(), tiles.end(), x,
                          [](const CatalogTile& t, std::int64_t to) { return t.x < to; });
}

}  // namespace

const TileBuffer* Catalog::find(TileIndex at) const noexcept {
  const auto row = place_of(rows, at.y);
  if (row == rows.end() || (*row)->y != at.y) return nullptr;
  const auto tile = place_in((*row)->tiles, at.x);
  return tile == (*row)->tiles.end() || tile->x != at.x ? nullptr : tile->buffer;
}

std::shared_ptr<const Catalog> Cataloguer::bring_up_to_date(TileStore& store, const ChangeLog& changes) {
  try {
    if (newest_ && store.watched()) {
      update(store, changes);
    } else {
      build(store);
    }
  } catch (...) {
    newest_.reset();
    throw;
  }
  version_ = changes.version();
  store.moved().clear();
  return newest_;
}

void Cataloguer::build(TileStore& store) {
  const std::uint64_t now = store.ages()->now();
  auto all = std::make_shared<Catalog>();
  all->born = now;
  for (const auto& [at, tile] : store.tiles()) {
    if (all->rows.empty() || all->rows.back()->y != at.y) {
      all->rows.push_back(std::make_shared<CatalogRow>());
      all->rows.back()->y = at.y;
      all->rows.back()->born = now;
    }
    CatalogRow& row = *all->rows.back();
    row.tiles.push_back({at.x, tile.buffer});
    row.last = std::max(row.last, tile.buffer->marks.last);
  }
  newest_ = std::move(all);
  store.watch(true);
}

/// The row to be changed: made, copied where a view sees it, or as it is.
CatalogRow& Cataloguer::own_row(const TileAges& ages, std::int64_t y) {
  if (ages.seen(newest_->born)) {
    newest_ = std::make_shared<Catalog>(*newest_);
    newest_->born = ages.now();
  }
  auto& rows = newest_->rows;
  auto at = rows.begin() + (place_of(rows, y) - rows.cbegin());
  if (at == rows.end() || (*at)->y != y) {
    at = rows.insert(at, std::make_shared<CatalogRow>());
    (*at)->y = y;
    (*at)->born = ages.now();
  } else if (ages.seen((*at)->born)) {
    *at = std::make_shared<CatalogRow>(**at);
    (*at)->born = ages.now();
  }
  return **at;
}

void Cataloguer::update(TileStore& store, const ChangeLog& changes) {
  const TileAges& ages = *store.ages();
  for (const TileIndex at : store.moved()) {
    const Tile* const tile = store.find(at);
    CatalogRow& row = own_row(ages, at.y);
    auto place = place_in(row.tiles, at.x);
    const bool known = place != row.tiles.end() && place->x == at.x;
    if (tile != nullptr) {
      if (!known) place = row.tiles.insert(place, CatalogTile{at.x, nullptr});
      place->buffer = tile->buffer;
    } else if (known) {
      row.tiles.erase(place);
      if (row.tiles.empty()) newest_->rows.erase(place_of(newest_->rows, at.y));
    } else if (row.tiles.empty()) {
      newest_->rows.erase(place_of(newest_->rows, at.y));  // made and dropped between two views
    }
  }
  for (const Tile* t = changes.newest(); t != nullptr && t->buffer->marks.last > version_; t = t->older) {
    CatalogRow& row = own_row(ages, t->index.y);
    row.last = std::max(row.last, t->buffer->marks.last);
  }
}

}  // namespace evigrid
