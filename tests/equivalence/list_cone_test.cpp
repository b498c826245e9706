// SPDX-License-Identifier: Apache-2.0
// The lists of micro-tiles that kernels take, against bands read column by column: every micro-tile of every zone once,
// at its place and its offset, whatever part of a cone a tile has.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

using Listed = std::set<std::tuple<int, const float*, float, float>>;  // zone, cells, x, y

struct Case {
  std::vector<ConeCuts> bands;
  ConeTile tile;
};

/// Footprints that begin before the tile, within it or behind it, with empty runs, bands and zones among them.
Case random_case(std::mt19937& rng, float* cells) {
  const auto any = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(rng); };
  Case c;
  c.bands.resize(static_cast<std::size_t>(any(1, 40)));
  const int reach = any(0, 2) == 0 ? 4 : 60;
  for (ConeCuts& b : c.bands) {
    for (auto& cut : b.column) cut = any(-reach, reach);
    std::sort(b.column, b.column + ConeBands::kCuts);
    if (any(0, 5) == 0) std::fill(b.column, b.column + ConeBands::kCuts, b.column[0]);
  }
  const int bands = static_cast<int>(c.bands.size());
  ConeTile& t = c.tile;
  t.cells = cells;
  t.step = any(2, kMostPlanes) * kMicroCells;
  t.first_band = any(-kMicrosPerSide, bands);
  t.first_row = std::max(-t.first_band, 0);
  t.end_row = std::min(kMicrosPerSide, bands - t.first_band);
  t.first_column = any(-20, 20);
  t.x0 = static_cast<float>(any(-4000, 4000)) + 0.25f;
  t.y0 = static_cast<float>(any(-4000, 4000)) - 0.375f;
  return c;
}

Listed by_columns(const Case& c, std::uint64_t& squares) {
  constexpr int kZone[] = {kRim, kWithin, kFree, kWithin, kRim};
  const ConeTile& t = c.tile;
  Listed out;
  squares = 0;
  for (int row = 0; row < kMicrosPerSide; ++row) {
    const int band = t.first_band + row;
    if (band < 0 || band >= static_cast<int>(c.bands.size())) continue;
    const auto& cut = c.bands[static_cast<std::size_t>(band)].column;
    for (int column = 0; column < kMicrosPerSide; ++column) {
      const int at = t.first_column + column;
      for (int run = 0; run < 5; ++run) {
        if (at < cut[run] || at >= cut[run + 1]) continue;
        out.insert({kZone[run], t.cells + (row * kMicrosPerSide + column) * t.step,
                    t.x0 + static_cast<float>(4 * column), t.y0 + static_cast<float>(4 * row)});
        squares |= std::uint64_t{1} << (row / 2 * 8 + column / 2);
      }
    }
  }
  return out;
}

TEST(ListCone, EveryMicroTileOnceInItsZone) {
  std::vector<float> cells(kMicrosPerTile * kMostPlanes * kMicroCells);
  for (const char* name : {"scalar", "avx2", "avx512"}) {
    const KernelTable* table = find_table(name);
    if (table == nullptr) continue;
    SCOPED_TRACE(name);
    std::mt19937 rng(12);
    std::size_t listed = 0;
    for (int i = 0; i < 4000; ++i) {
      const Case c = random_case(rng, cells.data());
      constexpr std::size_t kRoom = kMicrosPerTile + kListAtOnce, kBehind = 4;
      std::vector<float*> at[kConeZones];
      std::vector<float> x[kConeZones], y[kConeZones];
      ListedMicros out[kConeZones];
      for (int z = 0; z < kConeZones; ++z) {
        at[z].assign(kRoom + kBehind, nullptr);
        x[z].assign(kRoom + kBehind, -1), y[z].assign(kRoom + kBehind, -1);
        out[z] = {at[z].data(), x[z].data(), y[z].data(), -1};
      }
      const std::uint64_t squares = table->list_cone(c.bands.data(), c.tile, out);
      Listed got;
      for (int z = 0; z < kConeZones; ++z) {
        for (int k = 0; k < out[z].count; ++k) {
          const auto n = static_cast<std::size_t>(k);
          EXPECT_TRUE(got.insert({z, at[z][n], x[z][n], y[z][n]}).second);
        }
        for (std::size_t k = kRoom; k < kRoom + kBehind; ++k) EXPECT_EQ(at[z][k], nullptr);  // no more than the room
      }
      std::uint64_t expected_squares = 0;
      EXPECT_EQ(got, by_columns(c, expected_squares)) << "case " << i;
      EXPECT_EQ(squares, expected_squares) << "case " << i;
      listed += got.size();
      if (HasFailure()) return;
    }
    EXPECT_GT(listed, 10'000u);
  }
}

}  // namespace
}  // namespace evigrid::kernels
