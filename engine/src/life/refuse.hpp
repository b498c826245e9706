// SPDX-License-Identifier: Apache-2.0
// The past once more, on some tiles: put back to an earlier version, then the scans since, restricted to them. A cell
// depends on the readings of its own tile in their order and on nothing else, so the other tiles need not be asked.
#pragma once
#include <span>
#include <vector>

#include "evigrid/map.hpp"
#include "evigrid/view.hpp"
#include "grid/admission.hpp"

namespace evigrid {

/// Tiles that each of the scans reached, of those that were integrated last in one call.
std::vector<std::vector<TileIndex>> tiles_reached(const Map&, std::size_t scans);
/// Tiles that a scan would reach. Throws std::length_error at the memory cap.
std::vector<TileIndex> tiles_of_scan(Map&, const Scan&);
/// These tiles as they were in the view, and vacuous where it has none. Throws before anything is changed.
void put_back(Map&, const TileSet&, const MapView&);
/// Whether all tiles can be dropped and so many made in their place, beside those that views hold and that stay in
/// memory. Throws std::length_error; in maps that page those go to the file.
void reserve_to_refuse(Map&, std::size_t tiles);
/// Fuses the scans on these tiles alone.
Report integrate_on(Map&, const TileSet&, std::span<const Scan>);
/// Gives them back.
void drop_tiles(Map&, const TileSet&);
TileSet all_tiles(const Map&);
bool is_vacuous(const Map&, TileIndex) noexcept;  ///< also where there is no tile
bool has_tile(const MapView&, TileIndex) noexcept;
std::int64_t last_stamp(const Map&) noexcept;
void set_last_stamp(Map&, std::int64_t stamp_ns);

}  // namespace evigrid
