// SPDX-License-Identifier: Apache-2.0
// The loops over the micro-tiles of one tile for one fan of beams: every cell of the footprint finds its beam and is
// updated once. Beam and class come from float arithmetic with a margin; the few cells inside the margin are decided
// exactly in double (fan_exact.hpp), so that every table agrees on every cell.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/one_sided.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state.hpp"
#include "kernels/row/fan_cells.hpp"
#include "kernels/row/fuse_cone.hpp"

#include "kernels/row/fan_exact.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

template <class State, bool kConflict>
struct FanUpdate {
  using V = Lanes::V;
  using Io = CellIo<State, kConflict>;
  static constexpr bool kOneSided = RuleOfMasses<State>::kThere;
  static constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  const FanReading q;  // a copy: no store into the map can alias it
  const FanReading& q_in;
  const TileArgs& args;
  const std::size_t stride;
  alignas(64) float left[kMicrosPerSide], low[kMicrosPerSide];  // offsets of the first cell of a column, of a row
  alignas(64) float spare[kMostPlanes * kMicroCells] = {};      // never seen
  V max_k{0.0f};
  Stats stats;

  FanUpdate(const TileArgs& a, const FanReading& reading)
      : q(reading), q_in(reading), args(a), stride(static_cast<std::size_t>(a.planes) * kMicroCells) {
    for (int m = 0; m < kMicrosPerSide; ++m) {
      left[m] = a.x0 + static_cast<float>(4 * m);
      low[m] = a.y0 + static_cast<float>(4 * m);
    }
    if constexpr (kOneSided) {
      for (int i = 0; i < kMicroCells; ++i) spare[2 * kMicroCells + i] = 1.0f;
    }
  }

  /// The micro-tiles of one step; missing ones are the spare, far outside or at the place of the first.
  struct Step {
    float* cell[Lanes::kMicros];
    float x[Lanes::kMicros], y[Lanes::kMicros];
  };
  EVIGRID_FN Step step(const float* list, int i, int n, bool far_outside) {
    Step s;
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < n;
      const int micro = static_cast<int>(list[there ? i + m : i]);
      s.cell[m] = there ? args.cells + static_cast<std::size_t>(micro) * stride : spare;
      s.x[m] = there || !far_outside ? left[micro % kMicrosPerSide] : 1e6f;
      s.y[m] = low[micro / kMicrosPerSide];
    }
    return s;
  }

  EVIGRID_FN void add_conflict(const Io& io, int part, const Lanes::M& where, const V& k) {
    if constexpr (kConflict) {
      float* const* plane = io.plane[Io::kPlanes];
      Lanes::store_all(plane, part, Lanes::load(plane, part) + k);
      if (args.rule.con || args.rule.last) [[unlikely]] {
        const Lanes::M inside = where;  // copies: the originals stay in registers
        const V what = k;
        keep_history(plane, part, inside, what, args.rule);
      }
    }
  }
  EVIGRID_FN void count_totals(const Lanes::M& total) {
    if (Lanes::any(total)) stats.total_conflicts += static_cast<std::uint64_t>(Lanes::count(total));
  }

  /// Micro-tiles wholly in the empty part: the same masses, without asking for the beam.
  void whole(const float* list, int n) {
    if constexpr (kOneSided) {
      whole_one_sided<typename RuleOfMasses<State>::type>(list, n);
    } else {
      for (int i = 0; i < n; i += Lanes::kMicros) {
        const Step s = step(list, i, n, true);
        const Io io(s.cell);
        for (int part = 0; part < kParts; ++part) {
          const V dx = Lanes::spread(s.x) + Lanes::column(part), dy = Lanes::spread(s.y) + Lanes::row(part);
          const V d = root(mul_add(dx, dx, dy * dy));
          io.fuse(part, measure_beam_plain(q, V(0.0f) > V(1.0f), d), d <= V(q.far), args.rule, stats, max_k);
        }
      }
    }
  }
  template <class Rule>
  void whole_one_sided(const float* list, int n) {
    V most = max_k;
    const auto all = V(1.0f) > V(0.0f);
    for (int i = 0; i < n; i += Lanes::kMicros) {
      const Step s = step(list, i, n, false);
      const Io io(s.cell);
      for (int part = 0; part < kParts; ++part) {
        const V dx = Lanes::spread(s.x) + Lanes::column(part), dy = Lanes::spread(s.y) + Lanes::row(part);
        const V d = root(mul_add(dx, dx, dy * dy));
        const Cell<V> old{Lanes::load(io.plane[0], part), Lanes::load(io.plane[1], part),
                          Lanes::load(io.plane[2], part)};
        const auto next = Rule::template combine<MapState>(old, measure_beam(q, V(q.empty), d));
        Lanes::store_all(io.plane[0], part, next.cell.a);
        Lanes::store_all(io.plane[1], part, next.cell.b);
        Lanes::store_all(io.plane[2], part, next.cell.u);
        add_conflict(io, part, all, next.k);
        most = max_of(most, next.k);  // the spare is never occupied: its k is 0
        if constexpr (Rule::kTotalPossible) count_totals(next.total);
      }
    }
    max_k = most;
    stats.cells += static_cast<std::uint64_t>(n) * kMicroCells;
  }

  /// Micro-tiles to be looked at cell by cell.
  template <class Classify>
  EVIGRID_FN void some(const float* list, int n, const Classify& classify) {
    const V zero(0.0f), one(1.0f), two(2.0f);
    V most = max_k;
    std::uint64_t cells_here = 0;
    for (int i = 0; i < n; i += Lanes::kMicros) {
      const Step s = step(list, i, n, true);
      const Io io(s.cell);
      for (int part = 0; part < kParts; ++part) {
        const V dx = Lanes::spread(s.x) + Lanes::column(part), dy = Lanes::spread(s.y) + Lanes::row(part);
        const V d = root(mul_add(dx, dx, dy * dy));
        FanClasses c = classify(i, dx, dy, d);
        if (Lanes::any(c.unsure)) {
          alignas(64) float cls[Lanes::kLanes], x[Lanes::kLanes], y[Lanes::kLanes], b[Lanes::kLanes];
          Lanes::store_flat(cls, select(c.occupied, two, select(c.empty, one, zero)));
          Lanes::store_flat(x, dx);
          Lanes::store_flat(y, dy);
          Lanes::store_flat(b, c.index);
          decide_exactly(q_in, Lanes::bits(c.unsure), x, y, b, cls);
          const V decided = Lanes::load_flat(cls);
          c.occupied = decided > V(1.5f);
          c.empty = both(decided > V(0.5f), decided < V(1.5f));
        }
        const auto touched = either(c.empty, c.occupied);
        if constexpr (kOneSided) {
          using Rule = typename RuleOfMasses<State>::type;
          // An occupied cell is the mirror image of an empty one.
          const V e = Lanes::load(io.plane[0], part), o = Lanes::load(io.plane[1], part),
                  u = Lanes::load(io.plane[2], part);
          const auto source = measure_beam(q, select(c.occupied, V(q.occupied), V(q.empty)), d);
          const auto next =
              Rule::template combine<MapState>(Cell<V>{select(c.occupied, o, e), select(c.occupied, e, o), u}, source);
          Lanes::store_all(io.plane[0], part, select(touched, select(c.occupied, next.cell.b, next.cell.a), e));
          Lanes::store_all(io.plane[1], part, select(touched, select(c.occupied, next.cell.a, next.cell.b), o));
          Lanes::store_all(io.plane[2], part, select(touched, next.cell.u, u));
          const V k = select(touched, next.k, zero);
          add_conflict(io, part, touched, k);
          most = max_of(most, k);
          cells_here += static_cast<std::uint64_t>(Lanes::count(touched));
          if constexpr (Rule::kTotalPossible) count_totals(both(touched, next.total));
        } else {
          io.fuse(part, measure_beam_plain(q, c.occupied, d), touched, args.rule, stats, most);
        }
      }
    }
    max_k = most;
    stats.cells += cells_here;
  }
};

template <class State, bool kConflict>
void fuse_fan_planes(const TileArgs& a, const FanReading& q, Stats& stats) {
  using V = Lanes::V;
  const FanMicros& f = *a.fan;
  FanUpdate<State, kConflict> update(a, q);
  update.whole(f.empty, f.empty_count);
  update.some(f.edge, f.edge_count - f.near_count, [&](int i, const V& dx, const V& dy, const V& d) EVIGRID_LAMBDA {
    return classify_in_window(update.q, f, i, dx, dy, d);
  });
  update.some(f.near, f.near_count, [&](int, const V& dx, const V& dy, const V& d) EVIGRID_LAMBDA {
    return classify_anywhere(update.q, dx, dy, d);
  });
  stats.cells += update.stats.cells;
  stats.total_conflicts += update.stats.total_conflicts;
  const float k = Lanes::reduce_max(update.max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class State>
void fuse_fan(const TileArgs& a, const FanReading& q, Stats& stats) {
  if (a.fan->empty_count + a.fan->edge_count == 0) return;
  if (a.conflict_plane) {
    fuse_fan_planes<State, true>(a, q, stats);
  } else {
    fuse_fan_planes<State, false>(a, q, stats);
  }
}

EVIGRID_CELL_END
