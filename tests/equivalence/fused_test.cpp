// SPDX-License-Identifier: Apache-2.0
// Fused equals unfused, bit for bit: masses that never leave the registers against masses written to memory and
// combined from there, for every table, rule and model. And the footprints lose no cell: listing every micro-tile
// changes nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

struct TileBuffer {
  alignas(64) float cells[4096 * 4];
  TileBuffer() {
    for (int i = 0; i < 4096 * 4; ++i) cells[i] = i / 16 % 4 == 2 ? 1.0f : 0.0f;
  }
};

TEST(Fused, EqualsUnfused) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(0, 1);
  auto measured = std::make_unique<Measured>();
  std::vector<std::uint8_t> micros(256);
  std::iota(micros.begin(), micros.end(), std::uint8_t{0});
  for (const char* table_name : {"scalar", "avx2", "avx512"}) {
    const KernelTable* table = find_table(table_name);
    if (table == nullptr) continue;
    ASSERT_EQ(table->name, table_name);
    for (int rule = 0; rule < kRules; ++rule) {
      for (const int model : {kHughes1992, kLi2014, kOriolo1997, kLi2006}) {
        const ConeType type({model, 0.05, 0.35, 0.1, 5, 0.93, 7.62, 0.98, 0.15, 0.35, 0.1, 80, 10, 0.01});
        auto fused = std::make_unique<TileBuffer>(), unfused = std::make_unique<TileBuffer>();
        Stats a, b;
        for (int i = 0; i < 30; ++i) {
          const ConeReading q = compile_cone(type, {3.2 * u(rng), 3.2 * u(rng), 6.3 * u(rng)}, 0.3 + 3 * u(rng));
          TileArgs args;
          args.conflict_plane = true;
          args.x0 = static_cast<float>(static_cast<double>(-q.i0) - q.fx);
          args.y0 = static_cast<float>(static_cast<double>(-q.j0) - q.fy);
          args.micros = micros.data();
          args.micro_count = 256;
          args.cells = fused->cells;
          table->fuse_cone[rule][model](args, q, a);
          args.cells = unfused->cells;
          table->measure_cone[model](args, q, *measured);
          table->combine_measured[rule][model](args, *measured, b);
        }
        EXPECT_GT(a.cells, 2000u);  // the comparison is not of nothing
        EXPECT_EQ(a.cells, b.cells);
        EXPECT_EQ(a.max_conflict, b.max_conflict);
        EXPECT_EQ(0, std::memcmp(fused->cells, unfused->cells, sizeof fused->cells)) << table_name << rule << model;
      }
    }
  }
}

}  // namespace
}  // namespace evigrid::kernels
