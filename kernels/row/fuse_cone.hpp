// SPDX-License-Identifier: Apache-2.0
// The loop over the micro-tiles of one tile for one cone: centre → polar → model → discount → rule → store, in
// registers.
#pragma once
#include "kernels/cell/discount.hpp"
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state.hpp"

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

template <class State, class Model, bool kConflict>
void fuse_cone_planes(const TileArgs& a, const ConeReading& q_in, Stats& stats) {
  const ConeReading q = q_in;  // a local copy: no store into the map can alias it
  ConeFrame frame;
  frame.build(a, q);
  const std::size_t stride = static_cast<std::size_t>(a.planes) * kMicroCells;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float spare[kMostPlanes * kMicroCells] = {};
  alignas(64) float nowhere[kMicroCells];  // offsets far outside every cone
  for (float& f : nowhere) f = 1e6f;
  Lanes::V max_k(0.0f);
  for (int i = 0; i < a.micro_count; i += Lanes::kMicros) {
    ConeStep step;
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < a.micro_count;
      const int micro = a.micros[there ? i + m : i];
      step.cell[m] = there ? a.cells + static_cast<std::size_t>(micro) * stride : spare;
      step.dx[m] = there ? frame.dx[micro % kMicrosPerSide] : nowhere;
      step.band[m] = micro / kMicrosPerSide;
    }
    const CellIo<State, kConflict> io(step.cell);
    for (int part = 0; part < kParts; ++part) {
      const auto at = locate(q, Lanes::load(step.dx, part), step.terms(frame, part));
      if (!Lanes::any(at.inside)) continue;
      const auto source = discounted(q, Model::measure(q, at.polar));
      io.fuse(part, source, at.inside, a.rule, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class State, class Model>
void fuse_cone(const TileArgs& a, const ConeReading& q, Stats& stats) {
  if (a.micro_count == 0) return;
  if (a.conflict_plane) {
    fuse_cone_planes<State, Model, true>(a, q, stats);
  } else {
    fuse_cone_planes<State, Model, false>(a, q, stats);
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
          widen(discounted(q, Model::measure(q, at.polar)));
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
template <class State, class Kind, bool kConflict>
void combine_measured_planes(const TileArgs& a, const Measured& in, Stats& stats) {
  const std::size_t stride = static_cast<std::size_t>(a.planes) * kMicroCells;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float spare[kMostPlanes * kMicroCells] = {}, none[kMicroCells] = {};
  Lanes::V max_k(0.0f);
  for (int i = 0; i < a.micro_count; i += Lanes::kMicros) {
    float* cell[Lanes::kMicros];
    alignas(64) float flag[Lanes::kMicros][kMicroCells];
    const float* source[Measured::kParts + 1][Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < a.micro_count;
      const int micro = a.micros[there ? i + m : i];
      cell[m] = there ? a.cells + static_cast<std::size_t>(micro) * stride : spare;
      for (int p = 0; p < Measured::kParts; ++p) source[p][m] = there ? in.part[p] + micro * kMicroCells : none;
      for (int c = 0; c < kMicroCells; ++c) flag[m][c] = there && (in.inside[micro] >> c & 1) != 0 ? 1.0f : 0.0f;
      source[Measured::kParts][m] = flag[m];
    }
    const CellIo<State, kConflict> io(cell);
    for (int part = 0; part < kParts; ++part) {
      const auto inside = Lanes::load(source[Measured::kParts], part) > Lanes::V(0.5f);
      if (!Lanes::any(inside)) continue;
      Parts<Lanes::V> s;
      for (int p = 0; p < Measured::kParts; ++p) s.part[p] = Lanes::load(source[p], part);
      io.fuse(part, narrow<Kind>(s), inside, a.rule, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class State, class Kind>
void combine_measured(const TileArgs& a, const Measured& in, Stats& stats) {
  if (a.micro_count == 0) return;
  if (a.conflict_plane) {
    combine_measured_planes<State, Kind, true>(a, in, stats);
  } else {
    combine_measured_planes<State, Kind, false>(a, in, stats);
  }
}

EVIGRID_CELL_END
