// SPDX-License-Identifier: Apache-2.0
// A source whose m(occupied) is zero, as a type: products with it vanish when the rule is compiled, so that every rule
// text gives a one-sided rule of its own. Bits stay equal: masses are finite and not negative, so x·0 is 0 and x + 0 is
// x. The opposite source is the mirror image (swap empty and occupied of cell and result: every rule is symmetric).
#pragma once
#include "kernels/cell/mass.hpp"

EVIGRID_CELL_BEGIN

struct Zero {};
template <class V>
EVIGRID_FN Zero operator*(const V&, Zero) {
  return {};
}
template <class V>
EVIGRID_FN Zero operator*(Zero, const V&) {
  return {};
}
EVIGRID_FN Zero operator*(Zero, Zero) { return {}; }
template <class V>
EVIGRID_FN V operator+(const V& a, Zero) {
  return a;
}
template <class V>
EVIGRID_FN V operator+(Zero, const V& a) {
  return a;
}
template <class V>
EVIGRID_FN Zero above(Zero, const V&) {
  return {};
}

/// Normalised and without paradoxical mass, as PlainSource; m(empty) = x, m(unknown) = v.
template <class V>
struct OneSided {
  V x;
  Zero y;
  V v;
};
template <class V>
EVIGRID_FN V scale(const OneSided<V>&) {
  return V(1.0f);
}
template <class V>
EVIGRID_FN V conflict_of(const OneSided<V>&, const V& k, const V&) {
  return k;
}
template <class V>
EVIGRID_FN OneSided<V> give_back(const OneSided<V>& m) {
  return {m.x, {}, m.v};
}
template <class V>
EVIGRID_FN OneSided<V> drop_paradox(const OneSided<V>& m) {
  return {m.x, {}, m.v};
}

EVIGRID_CELL_END
