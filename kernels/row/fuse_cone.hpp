// SPDX-License-Identifier: Apache-2.0
// The loop over the micro-tiles of one cone: centre → polar → model → discount → rule → store, in registers.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state.hpp"

#include "kernels/row/cone_cells.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// The planes behind the sum of conflict, of maps that keep them. Out of line: the others must not pay for it.
template <class = void>
__attribute__((noinline)) void keep_history(float* const* conflict, int part, const Lanes::M& inside, const Lanes::V& k,
                                            const RuleArgs& args) {
  float* at[Lanes::kMicros];
  const auto next_plane = [&](int n) EVIGRID_LAMBDA {
    for (int m = 0; m < Lanes::kMicros; ++m) at[m] = conflict[m] + n * kMicroCells;
  };
  if (args.con) {  // −ln(1 − k), of total conflict 27.6
    next_plane(1);
    const Lanes::V one(1.0f), step = log_one_plus(k / max_of(one - k, Lanes::V(1e-12f)));
    Lanes::store(at, part, inside, Lanes::load(at, part) + step);
  }
  if (args.last) {
    next_plane(args.con ? 2 : 1);
    Lanes::store(at, part, inside, k);
  }
}

/// Cells of the planes of one step: those of the state, then, where it is kept, the sum of conflict.
template <class State, bool kConflict>
struct CellIo {
  static constexpr int kPlanes = State::kPlanes;
  float* plane[kPlanes + 1][Lanes::kMicros];
  EVIGRID_FN explicit CellIo(float* const* cell) {
    for (int p = 0; p < kPlanes + 1; ++p) {
      for (int m = 0; m < Lanes::kMicros; ++m) plane[p][m] = cell[m] + p * kMicroCells;
    }
  }
  template <class S>
  EVIGRID_FN void fuse(int part, const S& source, const Lanes::M& inside, const RuleArgs& args, Stats& stats,
                       Lanes::V& max_k) const {
    Lanes::V old[kPlanes];
    for (int p = 0; p < kPlanes; ++p) old[p] = Lanes::load(plane[p], part);
    const auto next = State::template update<kConflict>(old, source, args);
    for (int p = 0; p < kPlanes; ++p) Lanes::store(plane[p], part, inside, next.plane[p]);
    const Lanes::V kk = select(inside, next.k, Lanes::V(0.0f));
    if constexpr (kConflict) {
      float* const* k = plane[kPlanes];
      Lanes::store(k, part, inside, Lanes::load(k, part) + kk);
      if (args.con || args.last) [[unlikely]] {
        const Lanes::M where = inside;  // copies: the originals stay in registers
        const Lanes::V what = kk;
        keep_history(k, part, where, what, args);
      }
    }
    max_k = max_of(max_k, kk);
    stats.cells += static_cast<std::uint64_t>(Lanes::count(inside));
    if constexpr (State::kTotalPossible) {
      const auto total = both(inside, next.total);
      if (Lanes::any(total)) stats.total_conflicts += static_cast<std::uint64_t>(Lanes::count(total));
    }
  }
};

/// The micro-tiles of a step: their cells, and where their offsets begin. Missing ones get the spare.
struct ConeStep {
  float* cell[Lanes::kMicros];
  ConeStep(const ZoneMicros& z, int i, float* spare) {
    for (int m = 0; m < Lanes::kMicros; ++m) cell[m] = i + m < z.count ? z.cells[i + m] : spare;
  }
};

template <class State, class Model, Paradox kParadox, ConeZone kZone, bool kConflict>
void fuse_zone(const ConeArgs& a, const ZoneMicros& z, const ConeReading& q, const ConeLanes& lanes, Stats& stats,
               Lanes::V& max_k_out) {
  constexpr int kPlanes = State::kPlanes + (kConflict ? 1 : 0);
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float spare[kMostPlanes * kMicroCells] = {};
  FirstCells first;
  Lanes::V max_k = max_k_out;
  for (int begin = 0; begin < z.count; begin += FirstCells::kMost) {
    const int n = z.count - begin < FirstCells::kMost ? z.count - begin : FirstCells::kMost;
    const float *const x = z.x + begin, *const y = z.y + begin;  // behind the last: anything, which lies outside
    first.fill<kAsksExcess<Model>>(q, x, y, n);
    for (int i = 0; i < n; i += Lanes::kMicros) {
      const ConeStep step(z, begin + i, spare);
      for (int m = 0; m < Lanes::kMicros; ++m) {
        const float* next = z.cells[begin + i + m + kConeAhead - Lanes::kMicros];
        for (int p = 0; p < kPlanes; ++p) __builtin_prefetch(next + p * kMicroCells);
      }
      const CellIo<State, kConflict> io(step.cell);
      for (int part = 0; part < kParts; ++part) {
        Polar<Lanes::V> at;
        const auto inside = locate<kZone, kAsksExcess<Model>>(q, lanes, first, x, y, i, part, at);
        if (!Lanes::any(inside)) continue;
        io.fuse(part, source_of<kParadox, Model, kZone>(q, at), inside, a.rule, stats, max_k);
      }
    }
  }
  max_k_out = max_k;
}

/// Every micro-tile cell by cell, whatever its zone: models that know none, and contextual discounts.
template <class State, class Model, bool kConflict>
void fuse_alike(const ConeArgs& a, const ConeReading& q, const ConeLanes& lanes, Stats& stats, Lanes::V& max_k) {
  for (const ZoneMicros& z : a.zone) fuse_zone<State, Model, kConsumed, kRim, kConflict>(a, z, q, lanes, stats, max_k);
}

template <class State, class Model, bool kConflict>
void fuse_cone_planes(const ConeArgs& a, const ConeReading& q_in, Stats& stats) {
  constexpr Paradox kParadox = paradox_of<State>();
  const ConeReading q = q_in;  // a local copy: no store into the map can alias it
  const ConeLanes lanes(q);
  Lanes::V max_k(0.0f);
  if constexpr (kTold<kParadox, Model>) {
    constexpr ConeZone kNearest = Model::kHasFreeZone && kParadox == kGivenBack ? kFree : kWithin;
    if (q.contextual.used) [[unlikely]] {
      fuse_alike<State, Model, kConflict>(a, q, lanes, stats, max_k);
    } else {
      fuse_zone<State, Model, kParadox, kNearest, kConflict>(a, a.zone[kFree], q, lanes, stats, max_k);
      fuse_zone<State, Model, kParadox, kWithin, kConflict>(a, a.zone[kWithin], q, lanes, stats, max_k);
      fuse_zone<State, Model, kParadox, kRim, kConflict>(a, a.zone[kRim], q, lanes, stats, max_k);
    }
  } else {
    fuse_alike<State, Model, kConflict>(a, q, lanes, stats, max_k);
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class State, class Model>
void fuse_cone(const ConeArgs& a, const ConeReading& q, Stats& stats) {
  if (a.conflict_plane) {
    fuse_cone_planes<State, Model, true>(a, q, stats);
  } else {
    fuse_cone_planes<State, Model, false>(a, q, stats);
  }
}

EVIGRID_CELL_END
