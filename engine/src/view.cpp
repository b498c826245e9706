// SPDX-License-Identifier: Apache-2.0
#include "evigrid/view.hpp"

#include "grid/readout.hpp"
#include "grid/view_state.hpp"
#include "io/map_access.hpp"

namespace evigrid {

Mass MapView::mass(CellIndex c) const noexcept { return read_cell(*state_, c).mass; }
float MapView::conflict(CellIndex c) const noexcept { return read_cell(*state_, c).conflict; }
float MapView::con(CellIndex c) const noexcept { return read_cell(*state_, c).con; }
float MapView::last_conflict(CellIndex c) const noexcept { return read_cell(*state_, c).last_conflict; }
CellIndex MapView::cell_at(double x_m, double y_m) const noexcept { return cell_of(x_m, y_m, params().cell_m); }
CellRect MapView::bounds() const { return occupied_bounds(*state_); }
void MapView::render(Layer layer, CellRect rect, std::span<float> out, std::ptrdiff_t stride,
                     const ReadOutParams& params) const {
  render_layer(*state_, layer, params, rect, out, stride);
}
void MapView::render(const Costmap& c, CellRect rect, std::span<std::int8_t> out, std::ptrdiff_t stride) const {
  render_costmap(*state_, occupancy_args(c), rect, out, stride);
}
void MapView::render(const Costmap& c, CellRect rect, std::span<std::uint8_t> out, std::ptrdiff_t stride) const {
  render_costmap(*state_, cost_args(c), rect, out, stride);
}
std::uint64_t MapView::hash() const { return hash_cells(*state_); }
const MapParams& MapView::params() const noexcept { return state_->facts().params; }
std::span<const Sensor> MapView::sensors() const noexcept { return *state_->facts().sensors; }
std::size_t MapView::tiles() const noexcept { return state_->size(); }
std::vector<std::string_view> MapView::plane_names() const {
  std::vector<std::string_view> names;
  for (const Plane& plane : state_->layout().planes) names.push_back(plane.name);
  return names;
}
std::vector<TilePlanes> MapView::tile_planes() const {
  static_assert(TilePlanes::kSide == kernels::kTileSide && TilePlanes::kBlock == kernels::kMicroSide);
  std::vector<TilePlanes> tiles;
  tiles.reserve(state_->size());
  for (const TileRef& tile : state_->in_order()) {
    tiles.push_back(
        {{tile.at.x * TilePlanes::kSide, tile.at.y * TilePlanes::kSide, TilePlanes::kSide, TilePlanes::kSide},
         tile.cells,
         state_->planes()});
  }
  return tiles;
}
std::uint64_t MapView::version() const noexcept { return state_->facts().losses.version; }
Changes MapView::changes(std::uint64_t since) const { return state_->changes(since); }

const TileSource& MapAccess::source(const MapView& v) noexcept { return *v.state_; }
const Admission& MapAccess::admission(const MapView& v) noexcept { return v.state_->facts().admission; }
std::int64_t MapAccess::last_stamp_ns(const MapView& v) noexcept { return v.state_->now_ns; }

}  // namespace evigrid
