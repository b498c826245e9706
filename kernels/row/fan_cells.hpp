// SPDX-License-Identifier: Apache-2.0
// The cells of a step of one fan: which beam and class each has, in float with a margin, and what it is told. Cells
// inside the margin are left to fan_exact.hpp.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/one_sided.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state.hpp"
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

EVIGRID_CELL_END
