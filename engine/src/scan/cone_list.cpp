// SPDX-License-Identifier: Apache-2.0
#include "scan/cone_list.hpp"

#include "scan/footprint.hpp"

namespace evigrid {

void ConeFootprint::find(const kernels::KernelTable& table, const kernels::ConeReading& q) {
  constexpr int kBlock = 64;
  const CellBox box = cone_box(q);
  column_ = q.i0 >> 2;
  row_ = box.y0 >> 2;
  x0_ = static_cast<float>(column_ * 4 - q.i0) - q.fx;
  y0_ = static_cast<float>(row_ * 4 - q.j0) - q.fy;
  bands_.count = static_cast<int>((box.y1 >> 2) - row_) + 1;
  bands_.capacity = (bands_.count + kBlock - 1) / kBlock * kBlock;
  const auto floats = static_cast<std::size_t>(kernels::ConeBands::kCuts * bands_.capacity);
  if (cuts_.size() < floats) cuts_.resize(floats);
  bands_.cut = cuts_.data();
  table.cone_bands(q, x0_, y0_, bands_);
}

bool ConeList::add(const ConeFootprint& f, const Tile& tile, int planes) {
  constexpr int kCuts = kernels::ConeBands::kCuts, kSide = kernels::kMicrosPerSide;
  constexpr int kZone[kCuts - 1] = {kernels::kRim, kernels::kWithin, kernels::kFree, kernels::kWithin, kernels::kRim};
  const std::size_t step = static_cast<std::size_t>(planes) * kernels::kMicroCells;
  for (int z = 0; z < kernels::kConeZones; ++z) {
    Zone& zone = zones_[static_cast<std::size_t>(z)];
    const std::size_t most =
        static_cast<std::size_t>(count_[static_cast<std::size_t>(z)] + kernels::kMicrosPerTile + kernels::kConeAhead);
    if (zone.cells.size() >= most) continue;
    zone.cells.resize(2 * most);
    zone.x.resize(2 * most);
    zone.y.resize(2 * most);
  }
  const int before = size();
  const auto first_row = static_cast<int>(tile.index.y * kSide - f.row_),
             first_column = static_cast<int>(tile.index.x * kSide - f.column_);
  const int end = std::min(first_row + kSide, f.bands_.count);
  for (int band = std::max(first_row, 0); band < end; ++band) {
    float* const row = tile.cells.get() + static_cast<std::size_t>((band - first_row) * kSide) * step;
    const float y = f.y0_ + static_cast<float>(4 * band);
    int from = std::clamp(f.cut(0, band) - first_column, 0, kSide);
    for (int c = 1; c < kCuts; ++c) {
      const int to = std::clamp(f.cut(c, band) - first_column, 0, kSide);
      const auto z = static_cast<std::size_t>(kZone[c - 1]);
      const auto n = static_cast<std::size_t>(count_[z]);
      float** const cells = zones_[z].cells.data() + n;
      float *const xs = zones_[z].x.data() + n, *const ys = zones_[z].y.data() + n;
      for (int i = 0; i < to - from; ++i) {
        cells[i] = row + static_cast<std::size_t>(from + i) * step;
        xs[i] = f.x0_ + static_cast<float>(4 * (first_column + from + i));
        ys[i] = y;
      }
      count_[z] += to - from;
      from = to;
    }
  }
  return size() > before;
}

kernels::ConeArgs ConeList::args(const Marks& from, const Marks& to) const noexcept {
  kernels::ConeArgs a;
  for (std::size_t z = 0; z < zones_.size(); ++z) {
    const auto n = static_cast<std::size_t>(from[z]);
    a.zone[z] = {zones_[z].cells.data() + n, zones_[z].x.data() + n, zones_[z].y.data() + n, to[z] - from[z]};
  }
  return a;
}

}  // namespace evigrid
