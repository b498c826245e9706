// SPDX-License-Identifier: Apache-2.0
// A million updates of the same cells, for every rule of maps and every model: the masses stay numbers that add up to
// 1, and none is ever denormal.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

constexpr int kUpdates = 1'000'000, kLookEvery = 997;

struct Micro {
  alignas(64) float cells[kMicroCells * 3];
};

TEST(Endless, AMillionUpdatesOfACellStayMasses) {
  const KernelTable& table = *find_table("auto");
  for (int rule = 0; rule < kRules; ++rule) {
    for (int model = 0; model < kConeModels; ++model) {
      const ConeType type({model, 0.05, 0.35, 0.1, 5, 1, 7.62, 1, 0.15, 0.35, 0.1, 80, 10, 0.01});
      // One micro-tile of a tile, before, on and behind what is heard: empty, occupied, and both in turn.
      std::vector<ConeReading> readings;
      for (const double range_m : {1.0, 1.6, 1.05, 2.5, 1.0})
        readings.push_back(compile_cone(type, {0.02, 1.6, 0}, range_m));
      for (const std::vector<int>& turns : {std::vector<int>{0}, {1}, {3}, {0, 1, 2, 3, 4}}) {
        const auto tile = std::make_unique<float[]>(4096 * 3 + 16);
        float* cells = tile.get();
        while (reinterpret_cast<std::uintptr_t>(cells) % 64 != 0) ++cells;
        const int micro = 8 * kMicrosPerSide + 5;  // 1.0 to 1.2 m ahead
        float* const listed[1 + kConeAhead] = {cells + micro * 3 * kMicroCells};
        for (int i = 0; i < 3 * kMicroCells; ++i)
          cells[micro * 3 * kMicroCells + i] = i < 2 * kMicroCells ? 0.0f : 1.0f;
        Stats stats;
        double worst = 0;
        for (int n = 0; n < kUpdates; ++n) {
          const ConeReading& q = readings[static_cast<std::size_t>(turns[static_cast<std::size_t>(n) % turns.size()])];
          const float x = static_cast<float>(static_cast<double>(4 * (micro % kMicrosPerSide) - q.i0) - q.fx);
          const float y = static_cast<float>(static_cast<double>(4 * (micro / kMicrosPerSide) - q.j0) - q.fy);
          ConeArgs args;
          args.zone[kRim] = {listed, &x, &y, 1};
          table.fuse_cone[rule][model](args, q, stats);
          if (n % kLookEvery != 0 && n + 1 != kUpdates) continue;
          const float* at = cells + micro * 3 * kMicroCells;
          for (int i = 0; i < kMicroCells; ++i) {
            const float e = at[i], o = at[kMicroCells + i], u = at[2 * kMicroCells + i];
            for (const float m : {e, o, u}) {
              ASSERT_TRUE(m == 0 || std::fpclassify(m) == FP_NORMAL) << rule << ' ' << model << ' ' << n << ": " << m;
            }
            worst = std::max(worst, std::fabs(static_cast<double>(e) + o + u - 1));
          }
        }
        EXPECT_GT(stats.cells, static_cast<std::uint64_t>(kUpdates)) << rule << ' ' << model << ' ' << turns.size();
        EXPECT_LE(worst, 4e-7) << rule << ' ' << model << ' ' << turns.size();
      }
    }
  }
}

}  // namespace
}  // namespace evigrid::kernels
