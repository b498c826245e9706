// SPDX-License-Identifier: Apache-2.0
// A million updates of the same cells, for every rule of maps and every model: the masses stay numbers that add up to
// 1, and no number of the state is ever denormal. A state that a turn of readings gave back bit for bit has been
// through all that is to come but a growing sum of conflict.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "engine/src/grid/cell_layout.hpp"
#include "engine/src/rule_kernels.hpp"
#include "kernels/row/compile_reading.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
namespace {

constexpr int kUpdates = 1'000'000, kLookEvery = 997;

bool is_number(float m) { return m == 0 || std::fpclassify(m) == FP_NORMAL; }

/// One micro-tile of a tile, 1.0 to 1.2 m ahead of a cone, updated again and again.
class OneMicro {
 public:
  OneMicro(const KernelTable& table, Rule map_rule, int model)
      : table_(table),
        map_rule_(map_rule),
        rule_(kernel_of(map_rule)),
        model_(model),
        planes_(planes_of({.rule = map_rule})),
        floats_(planes_.size() * kMicroCells),
        memory_(std::make_unique<float[]>(floats_ + 16)),
        at_(memory_.get()) {
    while (reinterpret_cast<std::uintptr_t>(at_) % 64 != 0) ++at_;
    listed_[0] = at_;
  }
  void clear() {
    for (std::size_t i = 0; i < floats_; ++i) at_[i] = planes_[i / kMicroCells].vacuous;
  }
  void update(const ConeReading& q, Stats& stats) {
    constexpr int kMicro = 8 * kMicrosPerSide + 5;
    const float x[1 + kConeAhead] = {
        static_cast<float>(static_cast<double>(4 * (kMicro % kMicrosPerSide) - q.i0) - q.fx)};
    const float y[1 + kConeAhead] = {
        static_cast<float>(static_cast<double>(4 * (kMicro / kMicrosPerSide) - q.j0) - q.fy)};
    ConeArgs args;
    args.planes = static_cast<int>(planes_.size());
    args.conflict_plane = true;
    args.zone[kRim] = {listed_, x, y, 1};
    table_.fuse_cone[rule_][model_](args, q, stats);
  }
  /// The planes of the rule's state, without the sum of conflict behind them, which only grows.
  [[nodiscard]] std::vector<float> state() const { return {at_, at_ + floats_ - kMicroCells}; }
  [[nodiscard]] bool state_is(const std::vector<float>& other) const {
    return std::memcmp(at_, other.data(), other.size() * sizeof(float)) == 0;
  }
  /// The largest distance of the masses' sum from what it must be.
  void expect_masses(double& worst, const std::string& where) const {
    for (std::size_t i = 0; i < floats_; ++i) {
      const Plane& plane = planes_[i / kMicroCells];
      ASSERT_TRUE(is_number(at_[i]) && at_[i] >= plane.least && at_[i] <= plane.most)
          << where << ' ' << plane.name << ": " << at_[i];
    }
    alignas(64) float masses[4 * kMicroCells];
    table_.read_out[rule_](at_, static_cast<int>(planes_.size()), 1, masses);
    for (int i = 0; i < kMicroCells; ++i) {
      const float e = masses[i], o = masses[16 + i], u = masses[32 + i], c = masses[48 + i];
      for (const float m : {e, o, u, c}) ASSERT_TRUE(is_number(m) && m >= 0 && m <= 1.001f) << where << ": " << m;
      const double sum = static_cast<double>(e) + o + u + c;  // of memberships 1 + 2 e o
      worst = std::max(worst, std::fabs(sum - 1 - (map_rule_ == Rule::fuzzy ? 2.0 * e * o : 0)));
    }
  }

 private:
  const KernelTable& table_;
  Rule map_rule_;
  int rule_, model_;
  std::vector<Plane> planes_;
  std::size_t floats_;
  std::unique_ptr<float[]> memory_;
  float* at_;
  float* listed_[1 + kConeAhead] = {};
};

class Endless : public testing::TestWithParam<Rule> {};

TEST_P(Endless, AMillionUpdatesOfACellStayMasses) {
  const KernelTable& table = *find_table("auto");
  for (int model = 0; model < kConeModels; ++model) {
    if (table.fuse_cone[kernel_of(GetParam())][model] == nullptr) continue;
    const ConeType type({model, 0.05, 0.35, 0.1, 5, 1, 7.62, 1, 0.15, 0.35, 0.1, 80, 10, 0.01});
    // Before, on and behind what is heard: empty, occupied, and both in turn.
    std::vector<ConeReading> readings;
    for (const double range_m : {1.0, 1.6, 1.05, 2.5, 1.0})
      readings.push_back(compile_cone(type, {0.02, 1.6, 0}, range_m));
    OneMicro cells(table, GetParam(), model);
    bool told = false;
    for (const std::vector<int>& turns : {std::vector<int>{0}, {1}, {3}, {0, 1, 2, 3, 4}}) {
      const int turn = static_cast<int>(turns.size());
      cells.clear();
      const std::vector<float> vacuous = cells.state();
      Stats stats;
      double worst = 0;
      std::vector<float> before;
      int n = 0;
      for (; n < kUpdates; ++n) {
        if (n % kLookEvery == 0) before = cells.state();
        if (n % kLookEvery == turn && cells.state_is(before)) break;
        cells.update(readings[static_cast<std::size_t>(turns[static_cast<std::size_t>(n % turn)])], stats);
        if (n % kLookEvery > turn && n + 1 != kUpdates) continue;  // every state of the turn that may be the last
        cells.expect_masses(worst,
                            std::string(name(GetParam())) + ' ' + std::to_string(model) + ' ' + std::to_string(n));
        if (HasFatalFailure()) return;
      }
      told = told || !cells.state_is(vacuous);
      EXPECT_GT(stats.cells, static_cast<std::uint64_t>(n)) << model << ' ' << turn;
      EXPECT_LE(worst, 4e-7) << model << ' ' << turn;
      std::printf("model %d, turns of %d: %d updates\n", model, turn, n);
    }
    EXPECT_TRUE(told) << model;
  }
}

/// Rules that are another one's kernel are tested as that one.
std::vector<Rule> rules_of_their_own() {
  std::vector<Rule> out;
  for (const Rule rule : map_rules()) {
    if (same_as(rule) == rule) out.push_back(rule);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Rules, Endless, testing::ValuesIn(rules_of_their_own()), [](const auto& rule) {
  std::string word(name(rule.param));
  std::replace(word.begin(), word.end(), '-', '_');
  return word;
});

}  // namespace
}  // namespace evigrid::kernels
