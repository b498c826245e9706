// SPDX-License-Identifier: Apache-2.0
// The loop over the micro-tiles of one tile for one cone: centre → polar → model → discount → rule → store, in
// registers.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"

#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

inline constexpr int kRowArrays = 11;

/// Offsets and row terms of a tile for one reading; lane i of a micro-tile is cell (i % 4, i / 4).
struct ConeFrame {
  alignas(64) float dx[kMicrosPerSide][kMicroCells];
  alignas(64) float rows[kRowArrays][kMicrosPerSide][kMicroCells];

  void build(const TileArgs& a, const ConeReading& q) {
    alignas(64) float dy[kMicrosPerSide][kMicroCells];
    for (int m = 0; m < kMicrosPerSide; ++m) {
      for (int i = 0; i < kMicroCells; ++i) {
        dx[m][i] = a.x0 + static_cast<float>(4 * m + i % 4);
        dy[m][i] = a.y0 + static_cast<float>(4 * m + i / 4);
      }
    }
    // Whole packs that cover the bands in use; a band is 16 floats.
    const int first = (a.micros[0] / kMicrosPerSide) / Lanes::kMicros * Lanes::kMicros * kMicroCells;
    const int last = (a.micros[a.micro_count - 1] / kMicrosPerSide + 1) * kMicroCells;
    for (int i = first; i < last; i += Lanes::kLanes) {
      const RowTerms<Lanes::V> r = row_terms(q, Lanes::load_flat(&dy[0][0] + i));
      const Lanes::V* terms[kRowArrays] = {&r.yy,         &r.wl,         &r.el,         &r.wr,
                                           &r.er,         &r.ring_hi[0], &r.ring_hi[1], &r.ring_hi[2],
                                           &r.ring_lo[0], &r.ring_lo[1], &r.ring_lo[2]};
      for (int t = 0; t < kRowArrays; ++t) Lanes::store_flat(&rows[t][0][0] + i, *terms[t]);
    }
  }
};

/// The micro-tiles of one step: pointers to their cells, offsets and row terms. Missing ones point at a spare.
struct ConeStep {
  float* cell[Lanes::kMicros];
  const float* dx[Lanes::kMicros];
  int band[Lanes::kMicros];

  EVIGRID_FN RowTerms<Lanes::V> terms(const ConeFrame& f, int part) const {
    RowTerms<Lanes::V> r;
    Lanes::V* out[kRowArrays] = {&r.yy,         &r.wl,         &r.el,         &r.wr,
                                 &r.er,         &r.ring_hi[0], &r.ring_hi[1], &r.ring_hi[2],
                                 &r.ring_lo[0], &r.ring_lo[1], &r.ring_lo[2]};
    for (int t = 0; t < kRowArrays; ++t) {
      const float* at[Lanes::kMicros];
      for (int m = 0; m < Lanes::kMicros; ++m) at[m] = f.rows[t][band[m]];
      *out[t] = Lanes::load(at, part);
    }
    return r;
  }
};

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

template <class Rule, class Model, bool kConflict>
void fuse_cone_planes(const TileArgs& a, const ConeReading& q_in, Stats& stats) {
  const ConeReading q = q_in;  // a local copy: no store into the map can alias it
  ConeFrame frame;
  frame.build(a, q);
  constexpr int kPlanes = kConflict ? 4 : 3;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float spare[4 * kMicroCells] = {};
  alignas(64) float nowhere[kMicroCells];  // offsets far outside every cone
  for (float& f : nowhere) f = 1e6f;
  Lanes::V max_k(0.0f);
  for (int i = 0; i < a.micro_count; i += Lanes::kMicros) {
    ConeStep step;
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < a.micro_count;
      const int micro = a.micros[there ? i + m : i];
      step.cell[m] = there ? a.cells + static_cast<std::size_t>(micro) * kMicroCells * kPlanes : spare;
      step.dx[m] = there ? frame.dx[micro % kMicrosPerSide] : nowhere;
      step.band[m] = micro / kMicrosPerSide;
    }
    const CellIo<kConflict> io(step.cell);
    for (int part = 0; part < kParts; ++part) {
      const auto at = locate(q, Lanes::load(step.dx, part), step.terms(frame, part));
      if (!Lanes::any(at.inside)) continue;
      const auto source = discount(Model::measure(q, at.polar), Lanes::V(q.reliability), Lanes::V(q.doubt));
      io.template fuse<Rule>(part, source, at.inside, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class Rule, class Model>
void fuse_cone(const TileArgs& a, const ConeReading& q, Stats& stats) {
  if (a.micro_count == 0) return;
  if (a.conflict_plane) {
    fuse_cone_planes<Rule, Model, true>(a, q, stats);
  } else {
    fuse_cone_planes<Rule, Model, false>(a, q, stats);
  }
}

template <class Model>
using SourceOf = decltype(Model::measure(ConeReading{}, Polar<Lanes::V>{}));

/// The same functions, cut in two: masses to memory …
template <class Model>
void measure_cone(const TileArgs& a, const ConeReading& q, Measured& out) {
  if (a.micro_count == 0) return;
  ConeFrame frame;
  frame.build(a, q);
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  for (int i = 0; i < a.micro_count; i += Lanes::kMicros) {
    ConeStep step;
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const int micro = a.micros[i + m < a.micro_count ? i + m : i];
      step.dx[m] = frame.dx[micro % kMicrosPerSide];
      step.band[m] = micro / kMicrosPerSide;
    }
    std::uint64_t bits = 0;
    for (int part = 0; part < kParts; ++part) {
      const auto at = locate(q, Lanes::load(step.dx, part), step.terms(frame, part));
      const Parts<Lanes::V> s =
          widen(discount(Model::measure(q, at.polar), Lanes::V(q.reliability), Lanes::V(q.doubt)));
      alignas(64) float masses[Measured::kParts][Lanes::kLanes];
      for (int p = 0; p < Measured::kParts; ++p) {
        Lanes::store_flat(masses[p], s.part[p]);
        for (int lane = 0; lane < Lanes::kLanes; ++lane) {
          const int at_micro = i + lane / kMicroCells;
          if (at_micro >= a.micro_count) break;
          out.part[p][a.micros[at_micro] * kMicroCells + (kParts > 1 ? part : lane % kMicroCells)] = masses[p][lane];
        }
      }
      bits |= Lanes::bits(at.inside) << (kParts > 1 ? part : 0);
    }
    for (int m = 0; m < Lanes::kMicros && i + m < a.micro_count; ++m) {
      out.inside[a.micros[i + m]] = static_cast<std::uint16_t>(bits >> (16 * m));
    }
  }
}

/// … and masses from memory into the map.
template <class Rule, class Kind, bool kConflict>
void combine_measured_planes(const TileArgs& a, const Measured& in, Stats& stats) {
  constexpr int kPlanes = kConflict ? 4 : 3;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float spare[4 * kMicroCells] = {}, none[kMicroCells] = {};
  Lanes::V max_k(0.0f);
  for (int i = 0; i < a.micro_count; i += Lanes::kMicros) {
    float* cell[Lanes::kMicros];
    alignas(64) float flag[Lanes::kMicros][kMicroCells];
    const float* source[Measured::kParts + 1][Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < a.micro_count;
      const int micro = a.micros[there ? i + m : i];
      cell[m] = there ? a.cells + static_cast<std::size_t>(micro) * kMicroCells * kPlanes : spare;
      for (int p = 0; p < Measured::kParts; ++p) source[p][m] = there ? in.part[p] + micro * kMicroCells : none;
      for (int c = 0; c < kMicroCells; ++c) flag[m][c] = there && (in.inside[micro] >> c & 1) != 0 ? 1.0f : 0.0f;
      source[Measured::kParts][m] = flag[m];
    }
    const CellIo<kConflict> io(cell);
    for (int part = 0; part < kParts; ++part) {
      const auto inside = Lanes::load(source[Measured::kParts], part) > Lanes::V(0.5f);
      if (!Lanes::any(inside)) continue;
      Parts<Lanes::V> s;
      for (int p = 0; p < Measured::kParts; ++p) s.part[p] = Lanes::load(source[p], part);
      io.template fuse<Rule>(part, narrow<Kind>(s), inside, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class Rule, class Kind>
void combine_measured(const TileArgs& a, const Measured& in, Stats& stats) {
  if (a.micro_count == 0) return;
  if (a.conflict_plane) {
    combine_measured_planes<Rule, Kind, true>(a, in, stats);
  } else {
    combine_measured_planes<Rule, Kind, false>(a, in, stats);
  }
}

EVIGRID_CELL_END
