// SPDX-License-Identifier: Apache-2.0
// A device played by this processor: the squares one after the other, their threads one after the other, readings in
// their order. Checks indexing and order where there is no device; it is as slow as it is simple.
#include <cstring>
#include <deque>

#include "kernels/device/device_cells.hpp"

EVIGRID_CELL_BEGIN

struct LaunchArgs {
  const DeviceBatch& batch;
  const DeviceRun& run;
  Stats& stats;
  std::uint64_t* reached;
};

template <class State, bool kForgets, class ReadingOf, class Fuse>
void each_square(const LaunchArgs& l, const ReadingAge* ages, const ReadingOf& reading_of, const Fuse& fuse) {
  const DeviceBatch& b = l.batch;
  const DeviceBatchArgs args{b.planes, b.age, b.conflict_plane, b.args};
  for (const DevicePart& part : b.parts.subspan(l.run.first_part, l.run.parts)) {
    const DeviceTile& tile = b.tiles[part.tile];
    for (int square = 0; square < kSquaresPerTile; ++square) {
      const Square16 at(tile, square);
      for (int thread = 0; thread < kSquareCells; ++thread) {
        const Place place(thread);
        float* const cell = tile.cells + place.offset(square, b.planes);
        OwnCell<State, kForgets> own;
        own.load(cell, args);
        for (const std::uint32_t r : b.reaches.subspan(part.first, part.count)) {
          if (!may_touch(reading_of(r), at)) continue;
          own.age.hears(ages, r);
          fuse(own, reading_of(r), at, place, args);
        }
        if (own.updates == 0) continue;
        own.store(cell, args);
        l.stats.cells += own.updates;
        l.stats.total_conflicts += own.totals;
        l.stats.max_conflict = max_of(l.stats.max_conflict, own.max_k);
        l.reached[part.tile] |= std::uint64_t{1} << block_of(square, place);
      }
    }
  }
}

template <class State, class Model, bool kForgets>
void launch_cones(const LaunchArgs& l) {
  each_square<State, kForgets>(
      l, l.batch.cone_ages.data(), [&](std::uint32_t r) -> const ConeReading& { return *l.batch.cones[r]; },
      [](auto& own, const ConeReading& q, const auto&... rest) { fuse_one<Model>(own, q, rest...); });
}
template <class State, bool kForgets>
void launch_fans(const LaunchArgs& l) {
  each_square<State, kForgets>(
      l, l.batch.fan_ages.data(), [&](std::uint32_t r) -> const FanReading& { return l.batch.fans[r]->reading; },
      [](auto& own, const FanReading& q, const auto&... rest) { fuse_one(own, q, rest...); });
}

EVIGRID_CELL_END

#include "kernels/device/dense_table.hpp"
#include "kernels/device/device_table.hpp"

EVIGRID_CELL_BEGIN
template <class Rule>
std::uint64_t dense_launch(const DensePlanes& p, std::size_t i) {
  return dense_cell<Rule>(p, i);
}
inline void fill_dense(DenseTable<std::uint64_t (*)(const DensePlanes&, std::size_t)>& t) {
  fill_dense_rules(t, []<class Rule>(Of<Rule>) { return dense_launch<Rule>; });
}
EVIGRID_CELL_END

namespace evigrid::kernels {
namespace {

class Emulated final : public Device {
 public:
  Emulated() {
    emulated::fill_dempster_and_yager_here(table_);
    emulated::fill_pcr_here(table_);
    emulated::fill_pcr14_here(table_);
    emulated::fill_states_here(table_);
    emulated::fill_dense(dense_);
  }
  [[nodiscard]] std::string name() const override { return "emulated device"; }
  float* take(std::size_t bytes) override { return memory_.emplace_back(bytes / sizeof(float)).data(); }
  void release() noexcept override { memory_.clear(); }

  DeviceResult fuse(const DeviceBatch& b) override {
    const std::size_t floats = static_cast<std::size_t>(kTileSide * kTileSide * b.planes);
    Stats stats;
    reached_.assign(b.tiles.size(), 0);
    for (const DeviceTile& t : b.tiles) {
      if (t.host != nullptr) std::memcpy(t.cells, t.host, floats * sizeof(float));
    }
    for (const DeviceRun& run : b.runs) {
      table_.of(b.rule, run.model, b.age >= 0)({b, run, stats, reached_.data()});
    }
    return {stats, reached_};
  }
  const float* fetch(std::span<const float* const> tiles, std::size_t floats) override {
    cells_.clear();
    for (const float* tile : tiles) cells_.insert(cells_.end(), tile, tile + floats);
    return cells_.data();
  }
  void arrived(std::size_t) override {}
  const std::uint8_t* costs(const CostArgs& args, std::span<const float* const> tiles, int planes) override {
    costs_.resize(tiles.size() * kTileSide * kTileSide);
    std::uint8_t* to = costs_.data();
    for (const float* tile : tiles) {
      for (int micro = 0; micro < kMicrosPerTile; ++micro) emulated::costs_of_micro(args, tile, planes, micro, to);
      to += kTileSide * kTileSide;
    }
    return costs_.data();
  }
  std::uint64_t combine(int rule, const DensePlanes& p, std::size_t n) override {
    std::uint64_t totals = 0;
    for (std::size_t i = 0; i < n; ++i) totals += dense_.cell[rule](p, i);
    return totals;
  }

 private:
  emulated::DeviceTable table_;
  emulated::DenseTable<std::uint64_t (*)(const DensePlanes&, std::size_t)> dense_;
  std::deque<std::vector<float>> memory_;
  std::vector<std::uint64_t> reached_;
  std::vector<float> cells_;
  std::vector<std::uint8_t> costs_;
};

}  // namespace

std::unique_ptr<Device> make_emulated_device() { return std::make_unique<Emulated>(); }

}  // namespace evigrid::kernels
