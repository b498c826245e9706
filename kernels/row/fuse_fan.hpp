// SPDX-License-Identifier: Apache-2.0
// The loops over the micro-tiles of one tile for one fan of beams: every cell of the footprint finds its beam and is
// updated once. Beam and class come from float arithmetic with a margin; the few cells inside the margin are decided
// exactly in double (fan_exact.hpp), so that every table agrees on every cell.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/one_sided.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state.hpp"
#include "kernels/row/fuse_cone.hpp"

#include "kernels/row/fan_exact.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// model `beam` (ours): the mass of the class, falling linearly with distance; the other one is zero.
template <class V>
EVIGRID_FN OneSided<V> measure_beam(const FanReading& q, const V& mass, const V& d) {
  const V one(1.0f), x = mass * neg_mul_add(d, V(q.fall), one);
  return {x, {}, one - x};
}

/// Classes of the cells of one step.
struct FanClasses {
  Lanes::M empty, occupied, unsure;  // unsure: too near a border for float
  Lanes::V index;                    // beam, or one beside it
};

/// By the angle of each cell and a gather: any place, any beam.
EVIGRID_FN FanClasses classify_anywhere(const FanReading& q, const Lanes::V& dx, const Lanes::V& dy,
                                        const Lanes::V& d) {
  using V = Lanes::V;
  const V zero(0.0f), one(1.0f), slack = mul_add(d, V(1e-6f), V(1e-6f));
  const auto reach = both(d >= V(q.near) - slack, d <= V(q.far) + slack);
  // Beam: index of the border below, with the fraction that says how sure it is.
  const V ahead = mul_add(V(q.mid_cos), dx, V(q.mid_sin) * dy), left = neg_mul_add(V(q.mid_sin), dx, V(q.mid_cos) * dy);
  const V t = mul_add(coarse_angle(ahead, left), V(q.beams_per_rad), V(q.half_beams));
  const V index = Lanes::floor(t), fraction = t - index;
  const V last(static_cast<float>(q.beams - 1));
  const auto near_fan = both(t >= V(-0.5f), index <= last + V(0.5f) + one);
  const auto on_beam = both(both(index >= zero, index <= last), both(d >= V(q.near), d <= V(q.far)));
  const V past = d - Lanes::gather(q.range, max_of(min_of(index, last), zero));
  const V in_margin = past + V(q.empty_margin), off_wall = magnitude(past) - V(q.half_width);
  const V ring = min_of(min_of(magnitude(in_margin), magnitude(off_wall)),
                        min_of(magnitude(d - V(q.near)), magnitude(d - V(q.far))));
  const auto at_border = magnitude(fraction - V(0.5f)) >= V(0.5f - q.angle_slack);
  const auto is_empty = in_margin < zero;
  return {both(on_beam, is_empty), both(on_beam, off_wall <= zero),
          both(both(reach, near_fan), either(at_border, ring <= slack)), index};
}

/// Micro-tiles at least four radii off, not behind the fan, beyond its near limit: the turn from the centre by one
/// division and an arc sine's series (|s| ≤ ¼: error 1.3e-7), the range out of a window of few beams.
EVIGRID_FN FanClasses classify_in_window(const FanReading& q, const FanMicros& f, int first, const Lanes::V& dx,
                                         const Lanes::V& dy, const Lanes::V& d) {
  using V = Lanes::V;
  const V zero(0.0f), slack = mul_add(d, V(1e-6f), V(1e-6f));
  const float* windows[Lanes::kMicros];
  for (int m = 0; m < Lanes::kMicros; ++m) windows[m] = q.range + static_cast<int>(f.lowest[first + m]);
  const V s = neg_mul_add(Lanes::spread(f.turn_y + first), dx, Lanes::spread(f.turn_x + first) * dy) / d;
  const V ss = s * s;
  const V bend = mul_add(mul_add(V(0.0446428571f), ss, V(0.075f)), ss, V(0.166666667f)) * ss;
  const V t = mul_add(mul_add(bend, s, s), V(q.beams_per_rad), Lanes::spread(f.place + first));
  const V index = Lanes::floor(t), fraction = t - index;
  const V past = d - Lanes::window(windows, index - Lanes::spread(f.lowest + first));
  const V in_margin = past + V(q.empty_margin), off_wall = magnitude(past) - V(q.half_width), rest = d - V(q.far);
  const V ring = min_of(min_of(magnitude(in_margin), magnitude(off_wall)), magnitude(rest));
  const auto at_border = magnitude(fraction - V(0.5f)) >= V(0.5f - q.angle_slack);
  const auto reach = rest <= zero;
  return {both(reach, in_margin < zero), both(reach, off_wall <= zero), either(at_border, ring <= slack), index};
}

/// The rule of a state of masses, whose text also has a one-sided form.
template <class State>
struct RuleOfMasses {
  static constexpr bool kThere = false;
};
template <class Rule>
struct RuleOfMasses<MassCells<Rule>> {
  static constexpr bool kThere = true;
  using type = Rule;
};

/// The same mass as a source of both kinds of cells, for states whose update has no one-sided form.
template <class V, class M>
EVIGRID_FN PlainSource<V> measure_beam_plain(const FanReading& q, const M& occupied, const V& d) {
  const V zero(0.0f), f = neg_mul_add(d, V(q.fall), V(1.0f));
  const V x = select(occupied, zero, V(q.empty) * f), y = select(occupied, V(q.occupied) * f, zero);
  return {x, y, V(1.0f) - (x + y)};
}

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
