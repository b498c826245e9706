// SPDX-License-Identifier: Apache-2.0
// What a sensor's reliability makes of a reading: first contextual discounting (Mercier, Quost & Denœux 2008), then
// Shafer's. Contextual: a source reliable with β1 when the cell is empty and with β2 when it is occupied is the source
// joined disjunctively with "not reliable here"; m(empty) keeps β2 of itself, for it is the claim that the cell is not
// occupied, and m(occupied) keeps β1.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/row/reading.hpp"

EVIGRID_CELL_BEGIN

template <class V>
EVIGRID_FN PlainSource<V> contextual(const PlainSource<V>& m, const Contextual& c) {
  return {m.x * V(c.if_occupied), m.y * V(c.if_empty),
          mul_add(m.x, V(c.doubt_if_occupied), mul_add(m.y, V(c.doubt_if_empty), m.v))};
}
template <class V>
EVIGRID_FN Source<V> contextual(const Source<V>& m, const Contextual& c) {
  const V b1(c.if_empty), b2(c.if_occupied), d1(c.doubt_if_empty), d2(c.doubt_if_occupied);
  const V v = mul_add(m.x, d2, mul_add(m.y, d1, mul_add(m.z, d1 * d2, m.v)));
  return {b2 * mul_add(m.z, d1, m.x), b1 * mul_add(m.z, d2, m.y), v, m.z * (b1 * b2), m.s};
}

template <class V>
EVIGRID_FN FaintSource<V> contextual(const FaintSource<V>& m, const Contextual& c) {
  const Source<V> r = contextual(Source<V>{m.x, m.y, m.v, m.z, m.s}, c);
  return {r.x, r.y, r.v, r.z, r.s, r.z / nonzero(r.x + r.y)};
}
template <class V>
EVIGRID_FN ProbabilitySource<V> contextual(const ProbabilitySource<V>& m, const Contextual& c) {
  const PlainSource<V> r = contextual(PlainSource<V>{m.x, m.y, m.v}, c);
  return {r.x, r.y, r.v, mul_add(m.gap, V(c.if_empty), m.x * (V(c.if_empty) - V(c.if_occupied)))};
}
template <class V>
EVIGRID_FN YieldingSource<V> contextual(const YieldingSource<V>& m, const Contextual& c) {
  const PlainSource<V> r = contextual(PlainSource<V>{m.x, m.y, m.v}, c);
  return {r.x, r.y, r.v};
}

template <class V, template <class> class S>
EVIGRID_FN S<V> discounted(const ConeReading& q, const S<V>& m) {
  const V reliability(q.reliability), doubt(q.doubt);
  if (q.contextual.used) [[unlikely]] return discount(contextual(m, q.contextual), reliability, doubt);
  return discount(m, reliability, doubt);
}

EVIGRID_CELL_END
