// SPDX-License-Identifier: Apache-2.0
// One fan on one tile, two ways: as selected (whole micro-tiles, windows of beams, near ones), and with every
// micro-tile looked at cell by cell by the angle of each cell. Same bits, for every table, rule and kind of fan, with
// the apex in, beside and far from the tile. And the class of every cell against an exact search through all beams.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "kernels/row/fan_exact.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

constexpr double kDegree = M_PI / 180, kCell = 0.05;

struct Kind {
  int beams;
  double first_deg, step_deg, max_range_m;
};
constexpr Kind kKinds[] = {
    {181, -90, 1, 8},       {361, -90, 0.5, 8}, {360, 0, 1, 6},    {720, -180, 0.5, 6}, {361, -180, 1, 6},
    {1081, -135, 0.25, 10}, {7, -3, 0.9, 8},    {24, -180, 15, 6}, {72, -177.5, 5, 6},  {1, 0, 2, 8}};

FanType type_of(const Kind& k, double reliability) {
  return FanType({kCell, 0.1, k.max_range_m, reliability, k.beams, k.first_deg * kDegree, k.step_deg * kDegree, 0.4,
                  0.6, 0.15, 0.1});
}

/// A room with steps, gaps and refused beams: neighbours mostly agree, so that some squares are wholly empty.
std::vector<float> ranges_of(const Kind& k, std::mt19937& rng) {
  std::uniform_real_distribution<float> u(0, 1);
  std::vector<float> out;
  float wall = 1 + 7 * u(rng);
  for (int i = 0; i < k.beams; ++i) {
    if (u(rng) < 0.04f) wall = 0.3f + 9 * u(rng);
    out.push_back(u(rng) < 0.03f ? -1.0f : u(rng) < 0.03f ? 100.0f : wall + 0.02f * u(rng));
  }
  return out;
}

/// Of which nothing was ever said: unknown is 1 where the state of the rule holds masses, all planes are 0 elsewhere.
struct Tile {
  alignas(64) float cells[4096 * kMostPlanes] = {};
  explicit Tile(int rule) {
    if (rule > kConjunctive) return;
    for (int i = 0; i < 4096 * kMostPlanes; ++i) cells[i] = i / kMicroCells % kMostPlanes == 2 ? 1.0f : 0.0f;
  }
};

std::unique_ptr<FanMicros> every_micro() {
  auto all = std::make_unique<FanMicros>();
  for (int i = 0; i < kMicrosPerTile; ++i) all->near[i] = static_cast<float>(i);
  all->empty_count = 0;
  all->edge_count = all->near_count = kMicrosPerTile;
  return all;
}

/// Every third pose is exactly aligned.
SensorPose pose_of(int i, std::mt19937& rng) {
  std::uniform_real_distribution<double> u(-1, 1);
  if (i % 3 == 0) return {i % 40 * kCell, 1.6 - kCell / 2, i % 8 * 45 * kDegree};
  const double reach = i % 3 == 1 ? 1.6 : 7;  // in the tile; around it
  return {1.6 + reach * u(rng), 1.6 + reach * u(rng), 3.2 * u(rng)};
}

int slow_class(const FanReading& q, float dx, float dy) {
  for (int beam = 0; beam < q.beams; ++beam) {
    // A candidate two beams off sees only beams that do not hold the cell: asked of each beam alone.
    FanReading one = q;
    one.beams = 1;
    one.full_circle = false;
    one.range = q.range + beam;
    one.border_x = q.border_x + beam;
    one.border_y = q.border_y + beam;
    // Beam 0 holds its lower border, the others leave it to the beam below.
    const double below = static_cast<double>(q.border_x[beam]) * dy - static_cast<double>(q.border_y[beam]) * dx;
    if (beam > 0 && below == 0) continue;
    const double above =
        static_cast<double>(q.border_y[beam + 1]) * dx - static_cast<double>(q.border_x[beam + 1]) * dy;
    if (below < 0 || above < 0) continue;
    return fan_class_exact(one, dx, dy, 0);
  }
  return 0;
}

TEST(Fan, SelectedEqualsCellByCell) {
  const auto all = every_micro();
  auto selected = std::make_unique<FanMicros>();
  for (const char* name : {"scalar", "avx2", "avx512"}) {
    const KernelTable* table = find_table(name);
    if (table == nullptr) continue;
    std::uint64_t empties = 0, windows = 0, nears = 0;
    for (const Kind& k : kKinds) {
      std::mt19937 rng(11);
      const FanType type = type_of(k, 0.95);
      for (int rule = 0; rule < kRules; ++rule) {
        auto fast = std::make_unique<Tile>(rule), slow = std::make_unique<Tile>(rule);
        Stats a, b;
        for (int i = 0; i < 24; ++i) {
          Fan fan;
          fan.range = ranges_of(k, rng);
          table->compile_fan(type, pose_of(i, rng), fan);
          const FanReading& q = fan.reading;
          TileArgs args;
          args.planes = kMostPlanes;
          args.conflict_plane = true;
          args.x0 = static_cast<float>(static_cast<double>(-q.i0) - q.fx);
          args.y0 = static_cast<float>(static_cast<double>(-q.j0) - q.fy);
          table->select_fan(q, args.x0, args.y0, *selected);
          empties += static_cast<std::uint64_t>(selected->empty_count);
          windows += static_cast<std::uint64_t>(selected->edge_count - selected->near_count);
          nears += static_cast<std::uint64_t>(selected->near_count);
          args.cells = fast->cells;
          args.fan = selected.get();
          table->fuse_fan[rule](args, q, a);
          args.cells = slow->cells;
          args.fan = all.get();
          table->fuse_fan[rule](args, q, b);
        }
        const auto what = std::string(name) + " rule " + std::to_string(rule) + " beams " + std::to_string(k.beams);
        EXPECT_GT(a.cells, 0u) << what;
        EXPECT_EQ(a.cells, b.cells) << what;
        EXPECT_EQ(a.total_conflicts, b.total_conflicts) << what;
        EXPECT_EQ(a.max_conflict, b.max_conflict) << what;
        EXPECT_EQ(0, std::memcmp(fast->cells, slow->cells, sizeof fast->cells)) << what;
      }
    }
    EXPECT_GT(empties, 1000u);  // each way was taken
    EXPECT_GT(windows, 1000u);
    EXPECT_GT(nears, 1000u);
  }
}

/// What a fan did to a vacuous tile, cell by cell, is what the search through all beams says.
TEST(Fan, ClassesEqualASearchThroughAllBeams) {
  auto selected = std::make_unique<FanMicros>();
  for (const char* name : {"scalar", "avx2", "avx512"}) {
    const KernelTable* table = find_table(name);
    if (table == nullptr) continue;
    std::uint64_t seen[3] = {};
    for (const Kind& k : kKinds) {
      if (k.beams * k.step_deg > 360.5) continue;  // overlapping ends: two beams hold a cell
      std::mt19937 rng(12);
      const FanType type = type_of(k, 1);
      for (int i = 0; i < 9; ++i) {
        Fan fan;
        fan.range = ranges_of(k, rng);
        table->compile_fan(type, pose_of(i, rng), fan);
        const FanReading& q = fan.reading;
        auto tile = std::make_unique<Tile>(kDempster);
        Stats stats;
        TileArgs args;
        args.planes = kMostPlanes;
        args.conflict_plane = true;
        args.cells = tile->cells;
        args.x0 = static_cast<float>(static_cast<double>(-q.i0) - q.fx);
        args.y0 = static_cast<float>(static_cast<double>(-q.j0) - q.fy);
        args.fan = selected.get();
        table->select_fan(q, args.x0, args.y0, *selected);
        table->fuse_fan[kDempster](args, q, stats);
        int wrong = 0;
        for (int y = 0; y < kTileSide; ++y) {
          for (int x = 0; x < kTileSide; ++x) {
            const float* cell =
                tile->cells + ((y / 4) * kMicrosPerSide + x / 4) * kMostPlanes * kMicroCells + y % 4 * 4 + x % 4;
            const int got = cell[0] > 0 ? 1 : cell[kMicroCells] > 0 ? 2 : 0;
            const int want = slow_class(q, args.x0 + static_cast<float>(x), args.y0 + static_cast<float>(y));
            wrong += got != want ? 1 : 0;
            ++seen[want];
          }
        }
        EXPECT_EQ(wrong, 0) << name << " beams " << k.beams << " pose " << i;
      }
    }
    for (const auto n : seen) EXPECT_GT(n, 1000u);
  }
}

}  // namespace
}  // namespace evigrid::kernels
