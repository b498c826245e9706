// SPDX-License-Identifier: Apache-2.0
// The cells of a step of one cone: where they lie, and what they are told, as far as their zone needs it.
#pragma once
#include "kernels/cell/discount.hpp"
#include "kernels/cell/mass.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/row/cone_lanes.hpp"

EVIGRID_CELL_BEGIN

/// Where the cells of one step lie, as far as its zone needs it, and which of them are in the cone.
template <ConeZone kZone, bool kExcess>
EVIGRID_FN auto locate(const ConeReading& q, const ConeLanes& lanes, const FirstCells& first, const float* x,
                       const float* y, int i, int part, Polar<Lanes::V>& at) {
  using V = Lanes::V;
  const V zero(0.0f);
  at.nl = (Lanes::spread(first.left_high + i) + Lanes::repeat(lanes.left_high, part)) +
          (Lanes::spread(first.left_low + i) + Lanes::repeat(lanes.left_low, part));
  at.nr = (Lanes::spread(first.right_high + i) + Lanes::repeat(lanes.right_high, part)) +
          (Lanes::spread(first.right_low + i) + Lanes::repeat(lanes.right_low, part));
  const auto between = min_of(at.nl, at.nr) >= zero;
  if constexpr (kZone == kFree) {
    return between;
  } else {
    const V dx = Lanes::spread(x + i) + Lanes::repeat(lanes.column, part),
            dy = Lanes::spread(y + i) + Lanes::repeat(lanes.row, part);
    const Square<V> yy(dy);
    at.d2 = mul_add(dx, dx, yy.high);
    if constexpr (kExcess) {  // d is rounded, and d − R with it: an occupied mass a few widths before R needs it better
      const V middle = Lanes::spread(first.excess + i) + Lanes::repeat(lanes.square, part);
      at.excess = mul_add(Lanes::spread(x + i), Lanes::repeat(lanes.column_twice, part),
                          mul_add(Lanes::spread(y + i), Lanes::repeat(lanes.row_twice, part), middle));
    }
    if constexpr (kZone == kWithin) {
      return between;
    } else {
      at.edge = ring_excess(q.ring[kEdge], dx, yy);
      at.outer = ring_excess(q.ring[kOuter], dx, yy);
      return both(between, both(at.outer <= zero, ring_excess(q.ring[kInner], dx, yy) >= zero));
    }
  }
}

template <class Model>
inline constexpr bool kAsksExcess = requires { Model::kAsksExcess; };

/// What a cone tells the cells of a step, discounted. Models that know no zones treat every cell alike.
template <Paradox kParadox, class Model>
inline constexpr bool kTold = kParadox != kConsumed&& requires {
  Model::kTellsByZone;
};
template <Paradox kParadox, class Model, ConeZone kZone>
EVIGRID_FN auto source_of(const ConeReading& q, const Polar<Lanes::V>& at) {
  if constexpr (!kTold<kParadox, Model>) {
    return discounted(q, Model::measure(q, at));
  } else if constexpr (kZone == kFree) {
    return Model::template told_free<Lanes::V>(q);
  } else {
    return Model::template told<kParadox, kZone == kRim>(q, at);
  }
}

EVIGRID_CELL_END
