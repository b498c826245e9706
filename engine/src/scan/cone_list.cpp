// SPDX-License-Identifier: Apache-2.0
#include "scan/cone_list.hpp"

#include "scan/footprint.hpp"

namespace evigrid {

ConeFootprint ConeFootprints::find(const kernels::KernelTable& table, const kernels::ConeReading& q) {
  constexpr int kBlock = 64, kCuts = kernels::ConeBands::kCuts;
  const CellBox box = cone_box(q);
  ConeFootprint f;
  f.column = q.i0 >> 2;
  f.row = box.y0 >> 2;
  f.x0 = static_cast<float>(f.column * 4 - q.i0) - q.fx;
  f.y0 = static_cast<float>(f.row * 4 - q.j0) - q.fy;
  f.bands = static_cast<int>((box.y1 >> 2) - f.row) + 1;
  f.first_band = static_cast<std::uint32_t>(bands_.size());
  kernels::ConeBands b;
  b.count = f.bands;
  b.capacity = (b.count + kBlock - 1) / kBlock * kBlock;
  if (cuts_.size() < static_cast<std::size_t>(kCuts * b.capacity))
    cuts_.resize(static_cast<std::size_t>(kCuts * b.capacity));
  b.cut = cuts_.data();
  table.cone_bands(q, f.x0, f.y0, b);
  bands_.resize(bands_.size() + static_cast<std::size_t>(f.bands));
  kernels::ConeCuts* const out = bands_.data() + f.first_band;
  for (int i = 0; i < f.bands; ++i) {
    for (int c = 0; c < kCuts; ++c) out[i].column[c] = static_cast<std::int32_t>(b.cut[c * b.capacity + i]);
    f.micros += out[i].column[kCuts - 1] - out[i].column[0];
  }
  return f;
}

BlockMask ConeList::add(const kernels::KernelTable& table, const ConeFootprint& f, const kernels::ConeCuts* bands,
                        const Tile& tile, int planes) {
  constexpr int kSide = kernels::kMicrosPerSide;
  const auto first_band = static_cast<int>(tile.index.y * kSide - f.row);
  kernels::ConeTile t;
  t.cells = tile.cells;
  t.step = planes * kernels::kMicroCells;
  t.first_row = std::max(-first_band, 0);
  t.end_row = std::min(kSide, f.bands - first_band);
  t.first_band = first_band;
  t.first_column = static_cast<int>(tile.index.x * kSide - f.column);
  t.x0 = f.x0 + static_cast<float>(4 * t.first_column);
  t.y0 = f.y0 + static_cast<float>(4 * first_band);
  kernels::ListedMicros out[kernels::kConeZones];
  for (std::size_t z = 0; z < kernels::kConeZones; ++z) out[z] = zones_[z].room(count_[z]);
  const BlockMask blocks = table.list_cone(bands, t, out);
  for (std::size_t z = 0; z < kernels::kConeZones; ++z) count_[z] += out[z].count;
  return blocks;
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
