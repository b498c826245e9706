// SPDX-License-Identifier: Apache-2.0
// Shortcuts against the long way, bit for bit, for every table, rule and model. Fused: masses that never leave the
// registers against masses written to memory and combined from there. Zones: micro-tiles sorted by what is known of all
// their cells against every micro-tile looked at cell by cell. Footprints: the micro-tiles that the bands list against
// all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "engine/src/grid/cell_layout.hpp"
#include "engine/src/rule_kernels.hpp"
#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

constexpr int kSide = 4 * kMicrosPerSide, kMicros = kSide * kSide;  // of a square of 4 × 4 tiles, 256 cells a side

/// The cells of the square, one micro-tile after the other.
class Square {
 public:
  explicit Square(const std::vector<Plane>& planes)
      : planes_(static_cast<int>(planes.size())), floats_(static_cast<std::size_t>(kMicros * per_micro()) + 16) {
    cells_ = floats_.data();
    while (reinterpret_cast<std::uintptr_t>(cells_) % 64 != 0) ++cells_;
    for (int i = 0; i < kMicros * per_micro(); ++i)
      cells_[i] = planes[static_cast<std::size_t>(i / kMicroCells % planes_)].vacuous;
  }
  [[nodiscard]] int planes() const { return planes_; }
  [[nodiscard]] float* micro(int column, int row) const { return cells_ + (row * kSide + column) * per_micro(); }
  [[nodiscard]] bool operator==(const Square& b) const {
    return std::memcmp(cells_, b.cells_, sizeof(float) * static_cast<std::size_t>(kMicros * per_micro())) == 0;
  }

 private:
  [[nodiscard]] int per_micro() const { return planes_ * kMicroCells; }
  int planes_;
  std::vector<float> floats_;
  float* cells_;
};

/// Micro-tiles of the square by zone.
class List {
 public:
  List(const Square& square, const ConeReading& q) : square_(square), q_(q) {}
  void add(int zone, int column, int row) {
    if (column < 0 || column >= kSide || row < 0 || row >= kSide) return;
    Zone& z = zones_[zone];
    ++z.count;
    z.cells.push_back(square_.micro(column, row));
    z.x.push_back(static_cast<float>(static_cast<double>(4 * column - q_.i0) - q_.fx));
    z.y.push_back(static_cast<float>(static_cast<double>(4 * row - q_.j0) - q_.fy));
  }
  [[nodiscard]] int count(int zone) const { return zones_[zone].count; }
  [[nodiscard]] ConeArgs args() {
    ConeArgs a;
    a.planes = square_.planes();
    a.conflict_plane = a.rule.con = a.rule.last = true;
    for (int z = 0; z < kConeZones; ++z) {
      const int n = count(z);
      const auto readable = static_cast<std::size_t>(n + kConeAhead);
      zones_[z].cells.resize(readable);
      zones_[z].x.resize(readable);
      zones_[z].y.resize(readable);
      a.zone[z] = {zones_[z].cells.data(), zones_[z].x.data(), zones_[z].y.data(), n};
    }
    return a;
  }

 private:
  struct Zone {
    int count = 0;
    std::vector<float*> cells;
    std::vector<float> x, y;
  };
  const Square& square_;
  const ConeReading& q_;
  Zone zones_[kConeZones];
};

List every_micro(const Square& s, const ConeReading& q) {
  List list(s, q);
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) list.add(kRim, column, row);
  }
  return list;
}

List by_bands(const KernelTable& table, const Square& s, const ConeReading& q) {
  std::vector<float> cuts(ConeBands::kCuts * 64);
  ConeBands bands{kSide, 64, cuts.data()};
  table.cone_bands(q, static_cast<float>(static_cast<double>(-q.i0) - q.fx),
                   static_cast<float>(static_cast<double>(-q.j0) - q.fy), bands);
  constexpr int kZone[] = {kRim, kWithin, kFree, kWithin, kRim};
  List list(s, q);
  for (int row = 0; row < kSide; ++row) {
    for (int run = 0; run + 1 < ConeBands::kCuts; ++run) {
      for (int c = static_cast<int>(cuts[run * 64 + row]); c < static_cast<int>(cuts[(run + 1) * 64 + row]); ++c)
        list.add(kZone[run], c, row);
    }
  }
  return list;
}

/// Poses in the square: random ones, and edges or axis along rows, columns, diagonals, apex on centres and corners.
std::vector<ConeReading> readings(const ConeType& type, std::mt19937& rng, int count) {
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<ConeReading> out;
  for (int i = 0; i < count; ++i) {
    const double cell = type.spec.cell_m, middle = 128 * cell;
    SensorPose pose{middle + 40 * cell * (u(rng) - 0.5), middle + 40 * cell * (u(rng) - 0.5), 6.3 * u(rng)};
    double range = 6 * cell + (type.spec.max_range_m - 6 * cell) * u(rng);
    if (i % 3 == 0) {
      const double turn[] = {-0.5, 0, 0.5};
      pose = {middle + 0.5 * cell * (i % 4), middle + 0.5 * cell * (i / 4 % 3),
              i / 3 % 8 * std::numbers::pi / 4 + turn[i / 24 % 3] * type.spec.aperture_rad};
      range = cell * static_cast<int>(range / cell);
    }
    out.push_back(compile_cone(type, pose, range));
  }
  return out;
}

ConeType sensor(int model, double aperture, double reliability) {
  return ConeType({model, 0.05, aperture, 0.1, 5, reliability, 7.62, 0.98, 0.15, 0.35, 0.1, 80, 10, 0.01});
}

/// Every kernel of maps once, and the planes of its cells.
std::vector<std::pair<int, std::vector<Plane>>> states() {
  std::vector<std::pair<int, std::vector<Plane>>> out;
  for (const Rule rule : map_rules()) {
    const int kernel = kernel_of(rule);
    if (std::any_of(out.begin(), out.end(), [&](const auto& s) { return s.first == kernel; })) continue;
    out.emplace_back(kernel, planes_of({.rule = rule, .keep_con = true, .keep_last_conflict = true}));
  }
  return out;
}

class EveryTable : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    table_ = find_table(GetParam());
    if (table_ == nullptr) GTEST_SKIP() << "this processor cannot run the " << GetParam() << " table";
    ASSERT_EQ(table_->name, GetParam());
  }
  const KernelTable* table_ = nullptr;
};

TEST_P(EveryTable, FusedEqualsUnfused) {
  std::mt19937 rng(3);
  auto measured = std::make_unique<Measured>();
  for (const auto& [rule, planes] : states()) {
    for (int model = 0; model < kConeModels; ++model) {
      if (table_->fuse_cone[rule][model] == nullptr) continue;
      Square fused(planes), unfused(planes);
      Stats a, b;
      for (const ConeReading& q : readings(sensor(model, 0.35, 0.93), rng, 30)) {
        List same(fused, q), other(unfused, q);  // as many micro-tiles as Measured has room for
        for (int row = 20; row < 36; ++row) {
          for (int column = 20; column < 36; ++column) other.add(kRim, column, row), same.add(kRim, column, row);
        }
        table_->fuse_cone[rule][model](same.args(), q, a);
        const ConeArgs args = other.args();
        table_->measure_cone[rule][model](args, q, *measured);
        table_->combine_measured[rule][model](args, *measured, b);
      }
      EXPECT_GT(a.cells, 2000u);  // the comparison is not of nothing
      EXPECT_EQ(a.cells, b.cells);
      EXPECT_EQ(a.max_conflict, b.max_conflict);
      EXPECT_TRUE(fused == unfused) << rule << ' ' << model;
    }
  }
}

TEST_P(EveryTable, ZonesChangeNoBitAndBandsLoseNoCell) {
  std::mt19937 rng(5);
  for (const auto& [rule, planes] : states()) {
    for (int model = 0; model < kConeModels; ++model) {
      if (table_->fuse_cone[rule][model] == nullptr) continue;
      const bool knows_zones = model == kHughes1992 || model == kLi2014;
      for (const double aperture : {0.26, 0.02, 0.52, 0.7}) {
        if (!knows_zones && aperture != 0.26) continue;
        Square zones(planes), cell_by_cell(planes);
        Stats a, b;
        int in_zone[kConeZones] = {};
        for (const ConeReading& q : readings(sensor(model, aperture, aperture < 0.3 ? 1 : 0.9), rng, 36)) {
          List list = by_bands(*table_, zones, q);
          for (int z = 0; z < kConeZones; ++z) in_zone[z] += list.count(z);
          table_->fuse_cone[rule][model](list.args(), q, a);
          List all = every_micro(cell_by_cell, q);
          table_->fuse_cone[rule][model](all.args(), q, b);
        }
        EXPECT_EQ(in_zone[kWithin] > 100, knows_zones) << model;
        EXPECT_GT(in_zone[kRim], 100);
        EXPECT_EQ(in_zone[kFree] > 100, model == kLi2014);
        EXPECT_EQ(a.cells, b.cells) << rule << ' ' << model << ' ' << aperture;
        EXPECT_EQ(a.max_conflict, b.max_conflict);
        EXPECT_EQ(a.total_conflicts, b.total_conflicts);
        EXPECT_TRUE(zones == cell_by_cell) << rule << ' ' << model << ' ' << aperture;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, EveryTable, testing::Values("scalar", "avx2", "avx512"),
                         [](const auto& which) { return std::string(which.param); });

}  // namespace
}  // namespace evigrid::kernels
