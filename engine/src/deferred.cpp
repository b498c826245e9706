// SPDX-License-Identifier: Apache-2.0
// States that combine when they are read: conjunctive part and column sums, or the last few readings.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "evigrid/joint.hpp"

namespace evigrid {

void DeferredCells::add(std::size_t cell, double e, double o, double u) {
  Cell& c = cells_.at(cell);
  c.k = c.k * ((e + o) + u) + (c.e * o + c.o * e);
  c.e = c.e * (e + u) + c.t * e;
  c.o = c.o * (o + u) + c.t * o;
  c.t *= u;
  c.column_e += e, c.column_o += o, c.column_u += u;
}

DeferredCells::Read DeferredCells::read(Rule rule, std::size_t cell) const {
  const Cell& c = cells_.at(cell);
  double e = c.e, o = c.o, u = c.t;
  const auto share = [&](double to_unknown) {
    const double sum = (c.column_e + c.column_o) + to_unknown;
    if (!(sum > 0)) return void(u += c.k);
    e += c.k * (c.column_e / sum);
    o += c.k * (c.column_o / sum);
    u += c.k * (to_unknown / sum);
  };
  switch (rule) {
    case Rule::yager:
    case Rule::dubois_prade:
      u += c.k;
      break;
    case Rule::pcr1:
      share(c.column_u);
      break;
    case Rule::pcr2:
    case Rule::pcr3:
      share(0);
      break;
    default:
      throw std::invalid_argument("rule: " + std::string(name(rule)) +
                                  " cannot be deferred: yager, dubois_prade, pcr1, pcr2, pcr3");
  }
  const double w = 1 / ((e + o) + u);
  return {e * w, o * w, u * w, c.k};
}

WindowCells::WindowCells(std::size_t cells, int depth) : depth_(static_cast<std::uint64_t>(depth)), count_(cells) {
  if (depth < 1 || depth > 64) {
    throw std::invalid_argument("depth: is " + std::to_string(depth) + ", must be within [1, 64]");
  }
  masses_.resize(cells * depth_);
}

void WindowCells::add(std::size_t cell, const Mass& m) {
  std::uint64_t& count = count_.at(cell);
  masses_[cell * depth_ + count % depth_] = m;
  ++count;
}

void WindowCells::read(Rule rule, Planes<float> out, Kernel kernel, Executor* executor) const {
  const std::size_t n = count_.size();
  std::fill(out.e, out.e + n, 0.0f);
  std::fill(out.o, out.o + n, 0.0f);
  std::fill(out.u, out.u + n, 1.0f);
  if (out.c != nullptr) std::fill(out.c, out.c + n, 0.0f);
  std::vector<float> e(n), o(n), u(n);
  for (std::uint64_t step = 0; step < depth_; ++step) {  // a vacuous source changes nothing where readings are fewer
    bool any = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t have = std::min(count_[i], depth_);
      const Mass m = step < have ? masses_[i * depth_ + (count_[i] - have + step) % depth_] : Mass{};
      e[i] = m.e, o[i] = m.o, u[i] = m.u;
      any = any || step < have;
    }
    if (!any) return;
    const Planes<const float> state{out.e, out.o, out.u, nullptr}, source{e.data(), o.data(), u.data(), nullptr};
    combine(rule, state, source, out, nullptr, n, kernel, executor);
  }
}

}  // namespace evigrid
