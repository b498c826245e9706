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

#include "engine/src/grid/cell_layout.hpp"
#include "engine/src/rule_kernels.hpp"
#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

struct TileBuffer {
  alignas(64) float cells[4096 * kMostPlanes] = {};
  explicit TileBuffer(const std::vector<Plane>& planes) {
    for (std::size_t i = 0; i < 4096 * planes.size(); ++i) cells[i] = planes[i / 16 % planes.size()].vacuous;
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
    for (const Rule map_rule : map_rules()) {
      const int rule = kernel_of(map_rule);
      const std::vector<Plane> planes = planes_of({.rule = map_rule, .keep_con = true, .keep_last_conflict = true});
      for (int model = 0; model < kConeModels; ++model) {
        const ConeType type({model, 0.05, 0.35, 0.1, 5, 0.93, 7.62, 0.98, 0.15, 0.35, 0.1, 80, 10, 0.01});
        auto fused = std::make_unique<TileBuffer>(planes), unfused = std::make_unique<TileBuffer>(planes);
        Stats a, b;
        for (int i = 0; i < 30; ++i) {
          const ConeReading q = compile_cone(type, {3.2 * u(rng), 3.2 * u(rng), 6.3 * u(rng)}, 0.3 + 3 * u(rng));
          TileArgs args;
          args.planes = static_cast<int>(planes.size());
          args.conflict_plane = args.rule.con = args.rule.last = true;
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
        EXPECT_EQ(0, std::memcmp(fused->cells, unfused->cells, sizeof fused->cells))
            << table_name << name(map_rule) << model;
      }
    }
  }
}

}  // namespace
}  // namespace evigrid::kernels
