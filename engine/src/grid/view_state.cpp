// SPDX-License-Identifier: Apache-2.0
#include "grid/view_state.hpp"

#include <algorithm>

namespace evigrid {

ViewState::ViewState(const TileStore& store, std::shared_ptr<const Catalog> catalog, Facts facts)
    : TileSource(store.shared_layout()),
      ages_(store.ages()),
      catalog_(std::move(catalog)),
      facts_(std::move(facts)),
      tiles_(store.size()),
      age_(ages_->open_view()) {
  now_ns = store.now_ns;
}

ViewState::~ViewState() {
  catalog_.reset();  // before the writer may take the rows for its own
  ages_->close_view(age_);
}

const float* ViewState::cells_of(TileIndex at) const noexcept {
  const TileBuffer* buffer = catalog_->find(at);
  return buffer == nullptr ? nullptr : buffer->cells();
}

std::vector<TileRef> ViewState::in_order() const {
  std::vector<TileRef> out;
  out.reserve(size());
  for (const auto& row : catalog_->rows) {
    for (const CatalogTile& t : row->tiles) out.push_back({{row->y, t.x}, t.buffer->cells()});
  }
  return out;
}

Changes ViewState::changes(std::uint64_t since) const {
  Changes out = begin_changes(facts_.losses, since);
  since = listed_since(out, since);
  struct Changed {
    TileIndex at;
    const TileMarks* marks;
  };
  std::vector<Changed> tiles;
  for (const auto& row : catalog_->rows) {
    if (row->last <= since) continue;
    for (const CatalogTile& t : row->tiles) {
      if (t.buffer->marks.last > since) tiles.push_back({{row->y, t.x}, &t.buffer->marks});
    }
  }
  std::stable_sort(tiles.begin(), tiles.end(),
                   [](const Changed& a, const Changed& b) { return a.marks->last > b.marks->last; });
  for (const Changed& t : tiles) out.rects.push_back(changed_box(t.at, *t.marks, since));
  return out;
}

}  // namespace evigrid
