// SPDX-License-Identifier: Apache-2.0
#include "scan/dependent.hpp"

#include <algorithm>
#include <cmath>

#include "evigrid/combine.hpp"
#include "grid/cell_state.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid {
namespace {

constexpr int kCells = kernels::kMicroCells;
constexpr double kLeastUnknown = 1e-4;  // a weight has no end: as the rules of weights have it
using kernels::kLeastMass;
constexpr float kLeastOpen = 1e-30f;  // where a mass on empty ∩ occupied is kept
constexpr double kMostWeight = 700;

/// Denœux's weight of evidence of a mass x beside v unknown, as −ln w.
double weight_of(float x, float v) {
  return kernels::portable_log(1 + static_cast<double>(x) / std::max(static_cast<double>(v), kLeastUnknown));
}

/// Whether a cell's first reading is all that counts.
bool first_alone(Dependence policy) { return policy == Dependence::once_per_scan || policy == Dependence::independent; }

}  // namespace

void DependentReadings::add(const Sensor& s, float* micro, const float* heard) {
  policy_ = s.dependence;
  const float* const e = heard;
  const float* const o = heard + kCells;
  const float* const u = heard + 2 * kCells;
  if (std::all_of(e, e + 2 * kCells, [](float m) { return m == 0; })) return;
  const auto [found, is_new] = place_.try_emplace(micro, told_.size());
  if (is_new) told_.push_back({micro, {}, {}, {}});
  Told& t = told_[found->second];
  for (int i = 0; i < kCells; ++i) {
    if (e[i] == 0 && o[i] == 0) continue;
    if (t.readings[i]++ == 0) {
      const float sum = (e[i] + o[i]) + u[i];  // what it said of empty ∩ occupied is dropped
      t.first[0][i] = e[i] / sum, t.first[1][i] = o[i] / sum, t.first[2][i] = u[i] / sum;
    }
    if (first_alone(policy_)) continue;
    for (int side = 0; side < 2; ++side) {
      const double l = weight_of(side == 0 ? e[i] : o[i], u[i]);
      double& all = t.weight[side][i];
      all = policy_ == Dependence::cautious ? std::max(all, l) : std::min(all + s.weight_exponent * l, kMostWeight);
    }
  }
}

/// The masses of two simple supports (spec of dempster_log in docs/maths.md).
bool DependentReadings::source_of(Dependence policy, const Told& t, int i, float* x, float* y, float* v) {
  *x = 0, *y = 0, *v = 1;
  if (t.readings[i] == 0) return false;
  if (first_alone(policy) || (policy == Dependence::cautious && t.readings[i] == 1)) {
    *x = t.first[0][i], *y = t.first[1][i], *v = t.first[2][i];
    return true;
  }
  const double l1 = t.weight[0][i], l2 = t.weight[1][i], less = std::min(l1, l2);
  const double f1 = kernels::portable_exp(less - l1), f2 = kernels::portable_exp(less - l2);
  const double g = kernels::portable_exp(-std::max(l1, l2)), d = f1 + f2 - g;
  *x = static_cast<float>((1 - kernels::portable_exp(-l1)) * f2 / d);
  *y = static_cast<float>((1 - kernels::portable_exp(-l2)) * f1 / d);
  *v = static_cast<float>(g / d);
  return true;
}

void DependentReadings::fuse(const MapParams& params, const TileStore& store, kernels::Stats& stats) {
  const CellLayout& l = store.layout();
  const std::size_t n = told_.size() * kCells;
  cells_.resize(8 * n);
  float* const e = cells_.data();
  float *const o = e + n, *const u = o + n, *const c = u + n, *const x = c + n, *const y = x + n, *const v = y + n,
               *const k = v + n;
  const bool open = l.paradox >= 0;
  for (std::size_t m = 0; m < told_.size(); ++m) {
    const float* const cell = told_[m].micro;
    const std::size_t at = m * kCells;
    for (int i = 0; i < kCells; ++i) {
      const std::size_t j = at + static_cast<std::size_t>(i);
      e[j] = cell[i], o[j] = cell[kCells + i], u[j] = cell[2 * kCells + i];
      c[j] = open ? cell[l.paradox * kCells + i] : 0;
      if (!source_of(policy_, told_[m], i, x + j, y + j, v + j)) e[j] = 0, o[j] = 0, u[j] = 1, c[j] = 0;
    }
  }
  stats.total_conflicts +=
      combine(params.rule, Planes<const float>{e, o, u, open ? c : nullptr}, Planes<const float>{x, y, v},
              Planes<float>{e, o, u, open ? c : nullptr}, k, n, params.kernel);
  const float least = open ? kLeastOpen : kLeastMass;
  const auto floored = [least](float mass) { return mass < least ? 0.0f : mass; };
  for (std::size_t m = 0; m < told_.size(); ++m) {
    float* const cell = told_[m].micro;
    for (int i = 0; i < kCells; ++i) {
      if (told_[m].readings[i] == 0) continue;
      const std::size_t j = m * kCells + static_cast<std::size_t>(i);
      cell[i] = floored(e[j]), cell[kCells + i] = floored(o[j]);
      cell[2 * kCells + i] = std::max(u[j], 1e-30f);
      if (open) cell[l.paradox * kCells + i] = floored(c[j]);
      stats.max_conflict = std::max(stats.max_conflict, k[j]);
      if (l.conflict >= 0) cell[l.conflict * kCells + i] += k[j];
      if (l.con >= 0) cell[l.con * kCells + i] += weight_of_conflict(k[j]);
      if (l.last_conflict >= 0) cell[l.last_conflict * kCells + i] = k[j];
    }
  }
  told_.clear();
  place_.clear();
}

float* BlankMicros::blank(const std::vector<Plane>& planes, std::size_t count) {
  lines_.resize(count * planes.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    std::fill_n(lines_[i].cell, kCells, planes[i % planes.size()].vacuous);
  }
  return lines_.data()->cell;
}

}  // namespace evigrid
