// SPDX-License-Identifier: Apache-2.0
// A million updates of the same cells, for every rule of maps and every model: the masses stay numbers that add up to
// 1, and no number of the state is ever denormal.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/src/grid/cell_layout.hpp"
#include "engine/src/rule_kernels.hpp"
#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

constexpr int kUpdates = 1'000'000, kLookEvery = 997;

TEST(Endless, AMillionUpdatesOfACellStayMasses) {
  const KernelTable& table = *find_table("auto");
  for (const Rule map_rule : map_rules()) {
    if (same_as(map_rule) != map_rule) continue;
    const int rule = kernel_of(map_rule);
    const std::vector<Plane> planes = planes_of({.rule = map_rule});
    const std::size_t floats = planes.size() * kMicroCells;
    for (int model = 0; model < kConeModels; ++model) {
      if (table.fuse_cone[rule][model] == nullptr) continue;
      const ConeType type({model, 0.05, 0.35, 0.1, 5, 1, 7.62, 1, 0.15, 0.35, 0.1, 80, 10, 0.01});
      // One micro-tile of a tile, before, on and behind what is heard: empty, occupied, and both in turn.
      std::vector<ConeReading> readings;
      for (const double range_m : {1.0, 1.6, 1.05, 2.5, 1.0})
        readings.push_back(compile_cone(type, {0.02, 1.6, 0}, range_m));
      for (const std::vector<int>& turns : {std::vector<int>{0}, {1}, {3}, {0, 1, 2, 3, 4}}) {
        const auto tile = std::make_unique<float[]>(256 * floats + 16);
        float* cells = tile.get();
        while (reinterpret_cast<std::uintptr_t>(cells) % 64 != 0) ++cells;
        const int micro = 8 * kMicrosPerSide + 5;  // 1.0 to 1.2 m ahead
        float* const at = cells + static_cast<std::size_t>(micro) * floats;
        float* const listed[1 + kConeAhead] = {at};
        for (std::size_t i = 0; i < floats; ++i) at[i] = planes[i / kMicroCells].vacuous;
        Stats stats;
        double worst = 0;
        for (int n = 0; n < kUpdates; ++n) {
          const ConeReading& q = readings[static_cast<std::size_t>(turns[static_cast<std::size_t>(n) % turns.size()])];
          const float x[1 + kConeAhead] = {
              static_cast<float>(static_cast<double>(4 * (micro % kMicrosPerSide) - q.i0) - q.fx)};
          const float y[1 + kConeAhead] = {
              static_cast<float>(static_cast<double>(4 * (micro / kMicrosPerSide) - q.j0) - q.fy)};
          ConeArgs args;
          args.planes = static_cast<int>(planes.size());
          args.conflict_plane = true;
          args.zone[kRim] = {listed, x, y, 1};
          table.fuse_cone[rule][model](args, q, stats);
          if (n % kLookEvery != 0 && n + 1 != kUpdates) continue;
          alignas(64) float masses[4 * kMicroCells];
          table.read_out[rule](at, args.planes, 1, masses);
          const auto is_number = [](float m) { return m == 0 || std::fpclassify(m) == FP_NORMAL; };
          for (std::size_t i = 0; i < floats; ++i) {
            ASSERT_TRUE(is_number(at[i]) && at[i] >= planes[i / kMicroCells].least &&
                        at[i] <= planes[i / kMicroCells].most)
                << name(map_rule) << ' ' << model << ' ' << n << ' ' << planes[i / kMicroCells].name << ": " << at[i];
          }
          for (int i = 0; i < kMicroCells; ++i) {
            const float e = masses[i], o = masses[16 + i], u = masses[32 + i], c = masses[48 + i];
            for (const float m : {e, o, u, c})
              ASSERT_TRUE(is_number(m) && m >= 0 && m <= 1.001f) << name(map_rule) << m;
            const double sum = static_cast<double>(e) + o + u + c;  // of memberships 1 + 2 e o
            worst = std::max(worst, std::fabs(sum - 1 - (map_rule == Rule::fuzzy ? 2.0 * e * o : 0)));
          }
        }
        EXPECT_GT(stats.cells, static_cast<std::uint64_t>(kUpdates))
            << name(map_rule) << ' ' << model << ' ' << turns.size();
        EXPECT_LE(worst, 4e-7) << name(map_rule) << ' ' << model << ' ' << turns.size();
      }
    }
  }
}

}  // namespace
}  // namespace evigrid::kernels
