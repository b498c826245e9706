// SPDX-License-Identifier: Apache-2.0
// Where a cell centre lies in a cone, without an angle: the products with the two edge normals, whose signs decide
// membership (kernels/row/cone_lanes.hpp), d², and d² against the rings, whose sign is exact on the lattice of
// docs/maths.md: a sum of two floats for dy² − T², then one rounding.
#pragma once
#include "kernels/row/reading.hpp"

EVIGRID_CELL_BEGIN

template <class V>
struct Polar {
  V nl, nr;  // products with the normals of the left and right edge, in cells; both ≥ 0 inside
  V d2;      // squared distance, cells²
  // d² − T² of the model's own ring (compile_cone.cpp says which). `excess` to a few roundings of itself and of the
  // cells about, for models that ask; `edge` with exact sign, before `within_radius`: none.
  V excess, edge;
  V outer;  // d² − L² of the farthest ring, sign exact; at most 0 inside; before `within_radius`: none
};

/// dy² as two floats: exact.
template <class V>
struct Square {
  V high, low;
  EVIGRID_FN explicit Square(const V& dy) : high(dy * dy), low(mul_add(dy, dy, V(0.0f) - high)) {}
};

/// dx² + dy² − T².
template <class V>
EVIGRID_FN V ring_excess(const Ring& ring, const V& dx, const Square<V>& yy) {
  const V t(ring.hi);
  const V h = yy.high - t, b = h - yy.high;
  const V error = (yy.high - (h - b)) - (t + b);
  return mul_add(dx, dx, h) + (error + (yy.low - V(ring.lo)));
}

EVIGRID_CELL_END
