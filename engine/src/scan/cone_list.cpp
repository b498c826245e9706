// SPDX-License-Identifier: Apache-2.0
#include "scan/cone_list.hpp"

#include "scan/footprint.hpp"

namespace evigrid {
namespace {

/// Where the micro-tiles of a tile lie from its first cell, in cells: looked up, as turning small numbers into floats
/// costs more than the rest of the loop.
struct MicroPlaces {
  float x[kernels::kMicrosPerTile]{}, y[kernels::kMicrosPerTile]{};
  constexpr MicroPlaces() {
    for (int m = 0; m < kernels::kMicrosPerTile; ++m) {
      x[m] = static_cast<float>(4 * (m % kernels::kMicrosPerSide));
      y[m] = static_cast<float>(4 * (m / kernels::kMicrosPerSide));
    }
  }
};
constexpr MicroPlaces kPlaces;

}  // namespace

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
  Cuts* const out = bands_.data() + f.first_band;
  for (int i = 0; i < f.bands; ++i) {
    for (int c = 0; c < kCuts; ++c)
      out[i][static_cast<std::size_t>(c)] = static_cast<std::int32_t>(b.cut[c * b.capacity + i]);
  }
  return f;
}

// No branch depends on where a run ends: the micro-tiles of a tile are numbered in bytes, sixteen of them written for
// every run however short it is, and what follows overwrites the rest.
BlockMask ConeList::add(const ConeFootprint& f, const ConeFootprints::Cuts* bands, const Tile& tile, int planes) {
  constexpr int kSide = kernels::kMicrosPerSide, kRuns = kernels::ConeBands::kCuts - 1;
  constexpr std::size_t kZone[kRuns] = {kernels::kRim, kernels::kWithin, kernels::kFree, kernels::kWithin,
                                        kernels::kRim};
  const auto first_row = static_cast<int>(tile.index.y * kSide - f.row),
             first_column = static_cast<int>(tile.index.x * kSide - f.column);
  const int begin = std::max(first_row, 0), end = std::min(first_row + kSide, f.bands);
  std::uint8_t micro[kernels::kConeZones][kernels::kMicrosPerTile + kSide];
  std::array<int, kernels::kConeZones> n{};
  BlockMask blocks = 0;
  for (int band = begin; band < end; ++band) {
    ConeFootprints::Cuts cut = bands[band];
    for (auto& c : cut) c = std::min(std::max(c - first_column, 0), kSide);
    const BlockMask run = (BlockMask{1} << (cut[kRuns] + 1) / 2) - (BlockMask{1} << cut[0] / 2);
    blocks |= (cut[0] < cut[kRuns] ? run : 0) << ((band - first_row) / 2 * kBlocksPerSide);
    for (std::size_t r = 0; r < kRuns; ++r) {
      const auto first = static_cast<std::uint8_t>((band - first_row) * kSide + cut[r]);
      std::uint8_t* const to = micro[kZone[r]] + n[kZone[r]];
      for (std::uint8_t i = 0; i < kSide; ++i) to[i] = static_cast<std::uint8_t>(first + i);
      n[kZone[r]] += cut[r + 1] - cut[r];
    }
  }
  const auto step = static_cast<std::size_t>(planes) * kernels::kMicroCells;
  const float x0 = f.x0 + static_cast<float>(4 * first_column), y0 = f.y0 + static_cast<float>(4 * first_row);
  for (std::size_t z = 0; z < kernels::kConeZones; ++z) {
    Zone& zone = zones_[z];
    const auto had = static_cast<std::size_t>(count_[z]), add = static_cast<std::size_t>(n[z]);
    if (zone.cells.size() < had + add + kernels::kConeAhead) zone.grow(2 * (had + add) + kernels::kMicrosPerTile);
    float** const cells = zone.cells.data() + had;
    float *const xs = zone.x.data() + had, *const ys = zone.y.data() + had;
    for (std::size_t i = 0; i < add; ++i) {
      const std::size_t m = micro[z][i];
      cells[i] = tile.cells + m * step;
      xs[i] = x0 + kPlaces.x[m];
      ys[i] = y0 + kPlaces.y[m];
    }
    count_[z] += n[z];
  }
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
