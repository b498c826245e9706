// SPDX-License-Identifier: Apache-2.0
// "One number" of a SIMD table's batched combination and of the bands of a cone: one vector. A rule is a short chain
// and there is nothing to share between cells, so the processor interleaves the steps of a plain loop by itself; the
// packs of lane_highway.hpp only spilled registers here. A cone has few bands: a pack would be mostly empty. Included
// by exactly one batch_*.cpp per target, after HWY_TARGET is set.
#pragma once
#include <bit>
#include <cstdint>

#include "hwy/highway.h"

#define EVIGRID_FN HWY_INLINE
#define EVIGRID_CELL_BEGIN     \
  HWY_BEFORE_NAMESPACE();      \
  namespace evigrid::kernels { \
  namespace EVIGRID_TARGET_NAMESPACE {
#define EVIGRID_CELL_END \
  }                      \
  }                      \
  HWY_AFTER_NAMESPACE();

EVIGRID_CELL_BEGIN

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Vec = hn::Vec<Tag>;

struct VectorMask {
  hn::Mask<Tag> m;
};
struct Vector {
  Vec v;
  Vector() = default;
  HWY_INLINE explicit Vector(float c) : v(hn::Set(Tag(), c)) {}
  HWY_INLINE explicit Vector(Vec from) : v(from) {}
};

HWY_INLINE Vector operator+(Vector a, Vector b) { return Vector(hn::Add(a.v, b.v)); }
HWY_INLINE Vector operator-(Vector a, Vector b) { return Vector(hn::Sub(a.v, b.v)); }
HWY_INLINE Vector operator*(Vector a, Vector b) { return Vector(hn::Mul(a.v, b.v)); }
HWY_INLINE Vector operator/(Vector a, Vector b) { return Vector(hn::Div(a.v, b.v)); }
HWY_INLINE VectorMask operator>=(Vector a, Vector b) { return {hn::Ge(a.v, b.v)}; }
HWY_INLINE VectorMask operator<=(Vector a, Vector b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE VectorMask operator<(Vector a, Vector b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE VectorMask operator>(Vector a, Vector b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE VectorMask both(VectorMask a, VectorMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE VectorMask either(VectorMask a, VectorMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE Vector mul_add(Vector a, Vector b, Vector c) { return Vector(hn::MulAdd(a.v, b.v, c.v)); }
HWY_INLINE Vector neg_mul_add(Vector a, Vector b, Vector c) { return Vector(hn::NegMulAdd(a.v, b.v, c.v)); }
HWY_INLINE Vector root(Vector a) { return Vector(hn::Sqrt(a.v)); }
HWY_INLINE Vector select(VectorMask m, Vector a, Vector b) { return Vector(hn::IfThenElse(m.m, a.v, b.v)); }
/// As the scalar a > b ? a : b; no operand is ever NaN and no result depends on the sign of a zero.
HWY_INLINE Vector max_of(Vector a, Vector b) { return Vector(hn::Max(a.v, b.v)); }
HWY_INLINE Vector min_of(Vector a, Vector b) { return Vector(hn::Min(a.v, b.v)); }

struct Lanes {
  using V = Vector;
  using M = VectorMask;
  static constexpr int kLanes = HWY_LANES(float);

  static HWY_INLINE V load_flat(const float* p) { return V(hn::LoadU(Tag(), p)); }
  static HWY_INLINE void store_flat(float* p, V v) { hn::StoreU(v.v, Tag(), p); }
  static HWY_INLINE V floor(V x) { return V(hn::Floor(x.v)); }
  static HWY_INLINE V load_unorm16(const std::uint16_t* p) {
    const hn::Rebind<std::uint16_t, Tag> half;
    const hn::RebindToSigned<Tag> di;
    return V(hn::ConvertTo(Tag(), hn::PromoteTo(di, hn::LoadU(half, p))));
  }
  /// v + 2^23 ends in the nearest whole number, ties to even.
  static HWY_INLINE void store_unorm16(std::uint16_t* p, V v) {
    const hn::Rebind<std::uint16_t, Tag> half;
    const hn::RebindToUnsigned<Tag> du;
    hn::StoreU(hn::TruncateTo(half, hn::BitCast(du, hn::Add(v.v, hn::Set(Tag(), 8388608.0f)))), half, p);
  }
  static HWY_INLINE int count(M m) { return static_cast<int>(hn::CountTrue(Tag(), m.m)); }
  static HWY_INLINE bool any(M m) { return !hn::AllFalse(Tag(), m.m); }
};

EVIGRID_CELL_END
