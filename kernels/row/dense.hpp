// SPDX-License-Identifier: Apache-2.0
// The batched combination: n independent pairs over arrays, no floors. Loads of a step come before its stores, so C may
// be A or B. Operands hold no mass on empty ∩ occupied here (dense_double.cpp takes those); some results do.
#pragma once
#include "kernels/cell/mass.hpp"

#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

template <class Rule, class V>
EVIGRID_FN auto combine_exact(const V& ae, const V& ao, const V& au, const V& be, const V& bo, const V& bu) {
  return Rule::template combine<Exact>(Cell<V>{ae, ao, au}, PlainSource<V>{be, bo, bu});
}

template <class Rule>
std::uint64_t dense(const DensePlanes& p, std::size_t begin, std::size_t end) {
  constexpr std::size_t kStep = Lanes::kLanes;
  constexpr bool kOpen = requires(decltype(combine_exact<Rule>(Lanes::V(), {}, {}, {}, {}, {})) r) { r.c; };
  std::uint64_t totals = 0;
  const auto step = [&](const float* const in[6], float* const out[5]) EVIGRID_LAMBDA {
    const auto r = combine_exact<Rule>(Lanes::load_flat(in[0]), Lanes::load_flat(in[1]), Lanes::load_flat(in[2]),
                                       Lanes::load_flat(in[3]), Lanes::load_flat(in[4]), Lanes::load_flat(in[5]));
    Lanes::store_flat(out[0], r.cell.a);
    Lanes::store_flat(out[1], r.cell.b);
    Lanes::store_flat(out[2], r.cell.u);
    if (out[3] != nullptr) Lanes::store_flat(out[3], r.k);
    if constexpr (requires { r.c; }) {
      if (out[4] != nullptr) Lanes::store_flat(out[4], r.c);
    }
    if constexpr (Rule::kTotalPossible) {
      if (Lanes::any(r.total)) totals += static_cast<std::uint64_t>(Lanes::count(r.total));
    }
  };
  std::size_t i = begin;
  for (; i + kStep <= end; i += kStep) {
    const float* const in[6] = {p.ae + i, p.ao + i, p.au + i, p.be + i, p.bo + i, p.bu + i};
    float* const out[5] = {p.ce + i, p.co + i, p.cu + i, p.k != nullptr ? p.k + i : nullptr,
                           p.cc != nullptr ? p.cc + i : nullptr};
    step(in, out);
  }
  if (i < end) {  // the rest, through padded copies
    const std::size_t rest = end - i;
    alignas(64) float in_pad[6][kStep], out_pad[5][kStep] = {};
    const float* const from[6] = {p.ae + i, p.ao + i, p.au + i, p.be + i, p.bo + i, p.bu + i};
    for (int f = 0; f < 6; ++f) {
      for (std::size_t c = 0; c < kStep; ++c) in_pad[f][c] = c < rest ? from[f][c] : (f % 3 == 2 ? 1.0f : 0.0f);
    }
    const float* const in[6] = {in_pad[0], in_pad[1], in_pad[2], in_pad[3], in_pad[4], in_pad[5]};
    float* const out[5] = {out_pad[0], out_pad[1], out_pad[2], out_pad[3], out_pad[4]};
    step(in, out);
    float* const to[5] = {p.ce, p.co, p.cu, p.k, kOpen ? p.cc : nullptr};
    for (int f = 0; f < 5; ++f) {
      for (std::size_t c = 0; c < rest && to[f] != nullptr; ++c) to[f][i + c] = out_pad[f][c];
    }
  }
  return totals;
}

EVIGRID_CELL_END
