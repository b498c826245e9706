// SPDX-License-Identifier: Apache-2.0
// Changes of a map that no reading makes: areas forgotten, dropped, or written by hand. Each is one version.
#pragma once
#include <functional>
#include <span>

#include "evigrid/map.hpp"
#include "grid/admission.hpp"
#include "grid/change_log.hpp"
#include "grid/tile_store.hpp"

namespace evigrid {

struct Grid {
  const MapParams& params;
  TileStore& store;
  ChangeLog& changes;
};

/// Cells of rect are as never seen; tiles without any other are given back. Costs the tiles that meet it.
void forget(const Grid&, CellRect rect);
/// Cells of rect keep, from now on, what they hold now: time makes them forget nothing more.
void freeze(const Grid&, CellRect rect);
/// Drops the tiles outside; costs the rows of tiles and what is dropped.
void drop_outside(const Grid&, const TileRect& window);
/// Cells get the states of these masses and no history; of(x, y) is asked for the cells of rect, nullptr: left alone.
void write(const Grid&, CellRect rect, const std::function<const Mass*(std::int64_t, std::int64_t)>& of);

}  // namespace evigrid
