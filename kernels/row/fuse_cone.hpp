// SPDX-License-Identifier: Apache-2.0
// The loop over the micro-tiles of one cone: centre → polar → model → discount → rule → store, in registers.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"

#include "kernels/row/cone_cells.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// Cells of the planes of one step.
template <bool kConflict>
struct CellIo {
  float* e[Lanes::kMicros];
  float* o[Lanes::kMicros];
  float* u[Lanes::kMicros];
  float* k[Lanes::kMicros];
  EVIGRID_FN explicit CellIo(float* const* cell) {
    for (int m = 0; m < Lanes::kMicros; ++m) {
      e[m] = cell[m];
      o[m] = cell[m] + kMicroCells;
      u[m] = cell[m] + 2 * kMicroCells;
      k[m] = kConflict ? cell[m] + 3 * kMicroCells : nullptr;
    }
  }
  template <class Rule, class S>
  EVIGRID_FN void fuse(int part, const S& source, const Lanes::M& inside, Stats& stats, Lanes::V& max_k) const {
    const Cell<Lanes::V> old{Lanes::load(e, part), Lanes::load(o, part), Lanes::load(u, part)};
    const auto next = Rule::template combine<MapState>(old, source);
    Lanes::store(e, part, inside, next.cell.a);
    Lanes::store(o, part, inside, next.cell.b);
    Lanes::store(u, part, inside, next.cell.u);
    const Lanes::V kk = select(inside, next.k, Lanes::V(0.0f));
    if constexpr (kConflict) Lanes::store(k, part, inside, Lanes::load(k, part) + kk);
    max_k = max_of(max_k, kk);
    stats.cells += static_cast<std::uint64_t>(Lanes::count(inside));
    if constexpr (Rule::kTotalPossible) {
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

template <class Rule, class Model, ConeZone kZone, bool kConflict>
void fuse_zone(const ZoneMicros& z, const ConeReading& q, const ConeLanes& lanes, Stats& stats, Lanes::V& max_k_out) {
  constexpr int kPlanes = kConflict ? 4 : 3;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float spare[4 * kMicroCells] = {};
  alignas(64) float x[FirstCells::kMost], y[FirstCells::kMost];
  FirstCells first;
  Lanes::V max_k = max_k_out;
  for (int begin = 0; begin < z.count; begin += FirstCells::kMost) {
    const int n = z.count - begin < FirstCells::kMost ? z.count - begin : FirstCells::kMost;
    first.fill<kAsksExcess<Model>>(q, z.x + begin, z.y + begin, n);
    for (int i = 0; i < n; ++i) x[i] = z.x[begin + i], y[i] = z.y[begin + i];
    for (int i = n; i % Lanes::kMicros != 0; ++i) x[i] = y[i] = 1e6f;
    for (int i = 0; i < n; i += Lanes::kMicros) {
      const ConeStep step(z, begin + i, spare);
      for (int m = 0; m < Lanes::kMicros; ++m) {
        const float* next = z.cells[begin + i + m + kConeAhead - Lanes::kMicros];
        for (int p = 0; p < kPlanes; ++p) __builtin_prefetch(next + p * kMicroCells);
      }
      const CellIo<kConflict> io(step.cell);
      for (int part = 0; part < kParts; ++part) {
        Polar<Lanes::V> at;
        const auto inside = locate<kZone, kAsksExcess<Model>>(q, lanes, first, x, y, i, part, at);
        if (!Lanes::any(inside)) continue;
        io.template fuse<Rule>(part, source_of<paradox_of<Rule>(), Model, kZone>(q, at), inside, stats, max_k);
      }
    }
  }
  max_k_out = max_k;
}

template <class Rule, class Model, bool kConflict>
void fuse_cone_planes(const ConeArgs& a, const ConeReading& q_in, Stats& stats) {
  const ConeReading q = q_in;  // a local copy: no store into the map can alias it
  const ConeLanes lanes(q);
  Lanes::V max_k(0.0f);
  if constexpr (kTold<paradox_of<Rule>(), Model>) {
    constexpr ConeZone kNearest = Model::kHasFreeZone && paradox_of<Rule>() == kGivenBack ? kFree : kWithin;
    fuse_zone<Rule, Model, kNearest, kConflict>(a.zone[kFree], q, lanes, stats, max_k);
    fuse_zone<Rule, Model, kWithin, kConflict>(a.zone[kWithin], q, lanes, stats, max_k);
    fuse_zone<Rule, Model, kRim, kConflict>(a.zone[kRim], q, lanes, stats, max_k);
  } else {
    for (const ZoneMicros& z : a.zone) fuse_zone<Rule, Model, kRim, kConflict>(z, q, lanes, stats, max_k);
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class Rule, class Model>
void fuse_cone(const ConeArgs& a, const ConeReading& q, Stats& stats) {
  if (a.conflict_plane) {
    fuse_cone_planes<Rule, Model, true>(a, q, stats);
  } else {
    fuse_cone_planes<Rule, Model, false>(a, q, stats);
  }
}

EVIGRID_CELL_END
