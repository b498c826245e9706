// SPDX-License-Identifier: Apache-2.0
// Where a cell centre lies in a cone, without an angle: the products with the two edge normals, whose signs decide
// membership, and d² against the model's rings as sums of two floats. Exact on the lattice of docs/maths.md: Kahan's
// difference of products for the edges, two-float remainders for the rings; half of it is hoisted per row of cells.
#pragma once
#include <type_traits>

#include "kernels/row/reading.hpp"

EVIGRID_CELL_BEGIN

/// dy-dependent parts of one row of cells.
template <class V>
struct RowTerms {
  V yy;                      // dy²
  V wl, el, wr, er;          // dy·lx and dy·rx as rounded product and its error
  V ring_hi[3], ring_lo[3];  // dy² − T² exactly, as two floats, for each ring
};

template <class V>
EVIGRID_FN RowTerms<V> row_terms(const ConeReading& q, const V& dy) {
  RowTerms<V> r;
  const V zero(0.0f);
  const V ml = dy * V(q.lx), mr = dy * V(q.rx);
  r.wl = zero - ml;
  r.el = mul_add(dy, V(q.lx), r.wl);
  r.wr = mr;
  r.er = mul_add(dy, V(q.rx), zero - mr);
  r.yy = dy * dy;
  const V square_error = mul_add(dy, dy, zero - r.yy);
  for (int i = 0; i < 3; ++i) {
    const V t(q.ring[i].hi);
    const V h = r.yy - t, bb = h - r.yy;
    const V error = (r.yy - (h - bb)) - (t + bb);
    r.ring_hi[i] = h;
    r.ring_lo[i] = error + (square_error - V(q.ring[i].lo));
  }
  return r;
}

template <class V>
struct Polar {
  V nl, nr;  // products with the normals of the left and right edge, in cells; both ≥ 0 inside
  V d2;      // squared distance, cells²
  V edge;    // d² − T² of the model's own ring (compile_cone.cpp says which), sign exact
  V outer;   // d² − L² of the farthest ring, sign exact; at most 0 inside
};

template <class V, class M>
struct Located {
  Polar<V> polar;
  M inside;
};

template <class V>
EVIGRID_FN auto locate(const ConeReading& q, const V& dx, const RowTerms<V>& r) {
  const V zero(0.0f);
  const V nl = mul_add(dx, V(q.ly), r.wl) - r.el;
  const V nr = neg_mul_add(dx, V(q.ry), r.wr) + r.er;
  const V outer = mul_add(dx, dx, r.ring_hi[kOuter]) + r.ring_lo[kOuter];
  const V inner = mul_add(dx, dx, r.ring_hi[kInner]) + r.ring_lo[kInner];
  const V edge = mul_add(dx, dx, r.ring_hi[kEdge]) + r.ring_lo[kEdge];
  const auto inside = both(min_of(nl, nr) >= zero, both(outer <= zero, inner >= zero));
  return Located<V, std::remove_const_t<decltype(inside)>>{{nl, nr, mul_add(dx, dx, r.yy), edge, outer}, inside};
}

EVIGRID_CELL_END
