// SPDX-License-Identifier: Apache-2.0
// The batched combination: n independent pairs over arrays, no floors. Loads of a step come before its stores, so C may
// be A or B. Operands hold no mass on empty ∩ occupied here (dense_double.cpp takes those); some results do. How masses
// lie in memory is in arrays.hpp.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/row/arrays.hpp"
#include "kernels/row/fetch_ahead.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// One step: the pairs from cell i on, loaded before. Returns how many were in total conflict.
template <class Rule, class Arrays>
EVIGRID_FN std::uint64_t dense_step(const typename Arrays::Planes& p, std::size_t i,
                                    const Cell<Lanes::V>& a, const Cell<Lanes::V>& b) {
  const auto r = Rule::template combine<Exact>(a, PlainSource<Lanes::V>{b.a, b.b, b.u});
  Arrays::put(p, i, r.cell);
  if (p.k != nullptr) Lanes::store_flat(p.k + i, r.k);
  if constexpr (requires { r.c; }) Arrays::put_paradox(p, i, r.c);
  if constexpr (Rule::kTotalPossible) {
    if (Lanes::any(r.total)) return static_cast<std::uint64_t>(Lanes::count(r.total));
  }
  return 0;
}

/// Fewer pairs than one step has lanes, through padded copies.
template <class Rule, class Arrays>
std::uint64_t dense_part(const typename Arrays::Planes& p, std::size_t i, std::size_t count) {
  typename Arrays::Pads pads;
  const typename Arrays::Planes padded = pads.copy_of(p, i, count);
  const std::uint64_t totals = dense_step<Rule, Arrays>(padded, 0, Arrays::first(padded, 0), Arrays::second(padded, 0));
  pads.copy_back(p, i, count);
  return totals;
}

/// Four steps, their loads first. The memory then sees a few lines of a stream in a row, which its prefetchers follow
/// at full speed on Zen 5; line by line over six streams they gave 85 %.
template <class Rule, class Arrays>
EVIGRID_FN std::uint64_t dense_burst(const typename Arrays::Planes& p, std::size_t i) {
  constexpr std::size_t kStep = Lanes::kLanes;
  using Masses = Cell<Lanes::V>;  // not const: gcc 12 would keep them on the stack
  Masses a0 = Arrays::first(p, i), b0 = Arrays::second(p, i);
  Masses a1 = Arrays::first(p, i + kStep), b1 = Arrays::second(p, i + kStep);
  Masses a2 = Arrays::first(p, i + 2 * kStep), b2 = Arrays::second(p, i + 2 * kStep);
  Masses a3 = Arrays::first(p, i + 3 * kStep), b3 = Arrays::second(p, i + 3 * kStep);
  asm volatile("" ::: "memory");  // the compiler would move each load to where it is used
  std::uint64_t totals = dense_step<Rule, Arrays>(p, i, a0, b0);
  totals += dense_step<Rule, Arrays>(p, i + kStep, a1, b1);
  totals += dense_step<Rule, Arrays>(p, i + 2 * kStep, a2, b2);
  return totals + dense_step<Rule, Arrays>(p, i + 3 * kStep, a3, b3);
}

/// Where the processor needs it (fetch_ahead.hpp): how far ahead a pass in place fetches, 1 KB of each stream, and from
/// how many cells on: shorter ones lie in the cache, where fetching costs a fifth. Out of place it gains nothing.
inline constexpr std::size_t kFetchAhead = 256, kLongPass = std::size_t{1} << 16;

template <class Rule, class Arrays>
std::uint64_t dense(const typename Arrays::Planes& planes, std::size_t begin, std::size_t end) {
  constexpr std::size_t kStep = Lanes::kLanes, kBurst = 4 * kStep;
  const typename Arrays::Planes p = planes;  // in registers: no store can change it
  std::uint64_t totals = 0;
  std::size_t i = begin;
  if constexpr (kStep > 1) {  // up to the border of a cache line, so that no vector spans two of them
    if (const std::size_t head = std::min(Arrays::cells_to_line(p, i) % kStep, end - i); head > 0) {
      totals += dense_part<Rule, Arrays>(p, i, head);
      i += head;
    }
  }
  if constexpr (kStep > 1 && requires { Arrays::fetch(p, i, kBurst); }) {
    if (end - begin >= kLongPass && p.ce == p.ae && fetches_ahead()) {
      for (; i + kFetchAhead + kBurst <= end; i += kBurst) {
        Arrays::fetch(p, i + kFetchAhead, kBurst);
        totals += dense_burst<Rule, Arrays>(p, i);
      }
    }
  }
  for (; i + kBurst <= end; i += kBurst) totals += dense_burst<Rule, Arrays>(p, i);
  for (; i + kStep <= end; i += kStep) totals += dense_step<Rule, Arrays>(p, i, Arrays::first(p, i), Arrays::second(p, i));
  if (i < end) totals += dense_part<Rule, Arrays>(p, i, end - i);
  return totals;
}

EVIGRID_CELL_END
