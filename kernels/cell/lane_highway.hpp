// SPDX-License-Identifier: Apache-2.0
// "One number" of a SIMD table: U vectors side by side, so that the long chains of a cell's polynomials and divisions
// interleave. Included by exactly one table_*.cpp per target, after HWY_TARGET is set; the namespace is the target's
// own, so the linker can never merge two targets' code.
#pragma once
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
using VecMask = hn::Mask<Tag>;
inline constexpr int kVecLanes = HWY_LANES(float);
inline constexpr int kUnroll = EVIGRID_TARGET_UNROLL;

struct PackMask {
  VecMask v[kUnroll];
};

struct Pack {
  Vec v[kUnroll];
  Pack() = default;
  HWY_INLINE explicit Pack(float c) {
    for (int i = 0; i < kUnroll; ++i) v[i] = hn::Set(Tag(), c);
  }
};

#define EVIGRID_BINARY(op, expr)                                     \
  HWY_INLINE Pack op(const Pack& a, const Pack& b) {                 \
    Pack r;                                                          \
    for (int i = 0; i < kUnroll; ++i) r.v[i] = expr(a.v[i], b.v[i]); \
    return r;                                                        \
  }
#define EVIGRID_COMPARE(op, expr)                                    \
  HWY_INLINE PackMask op(const Pack& a, const Pack& b) {             \
    PackMask r;                                                      \
    for (int i = 0; i < kUnroll; ++i) r.v[i] = expr(a.v[i], b.v[i]); \
    return r;                                                        \
  }
#define EVIGRID_MASK(op, expr)                                       \
  HWY_INLINE PackMask op(const PackMask& a, const PackMask& b) {     \
    PackMask r;                                                      \
    for (int i = 0; i < kUnroll; ++i) r.v[i] = expr(a.v[i], b.v[i]); \
    return r;                                                        \
  }
EVIGRID_BINARY(operator+, hn::Add)
EVIGRID_BINARY(operator-, hn::Sub)
EVIGRID_BINARY(operator*, hn::Mul)
EVIGRID_BINARY(operator/, hn::Div)
EVIGRID_COMPARE(operator>=, hn::Ge)
EVIGRID_COMPARE(operator<=, hn::Le)
EVIGRID_COMPARE(operator<, hn::Lt)
EVIGRID_COMPARE(operator>, hn::Gt)
EVIGRID_MASK(both, hn::And)
EVIGRID_MASK(either, hn::Or)
#undef EVIGRID_BINARY
#undef EVIGRID_COMPARE
#undef EVIGRID_MASK

HWY_INLINE Pack mul_add(const Pack& a, const Pack& b, const Pack& c) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::MulAdd(a.v[i], b.v[i], c.v[i]);
  return r;
}
HWY_INLINE Pack neg_mul_add(const Pack& a, const Pack& b, const Pack& c) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::NegMulAdd(a.v[i], b.v[i], c.v[i]);
  return r;
}
HWY_INLINE Pack magnitude(const Pack& a) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Abs(a.v[i]);
  return r;
}
HWY_INLINE Pack root(const Pack& a) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Sqrt(a.v[i]);
  return r;
}
HWY_INLINE Pack select(const PackMask& m, const Pack& a, const Pack& b) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::IfThenElse(m.v[i], a.v[i], b.v[i]);
  return r;
}
/// As the scalar a > b ? a : b; no operand is ever NaN and no result depends on the sign of a zero.
HWY_INLINE Pack max_of(const Pack& a, const Pack& b) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Max(a.v[i], b.v[i]);
  return r;
}
HWY_INLINE Pack min_of(const Pack& a, const Pack& b) {
  Pack r;
  for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Min(a.v[i], b.v[i]);
  return r;
}
HWY_INLINE Pack scale_by_magic(const Pack& p, const Pack& magic) {
  const hn::RebindToUnsigned<Tag> du;
  Pack r;
  for (int i = 0; i < kUnroll; ++i) {
    r.v[i] = hn::BitCast(Tag(), hn::Add(hn::BitCast(du, p.v[i]), hn::ShiftLeft<23>(hn::BitCast(du, magic.v[i]))));
  }
  return r;
}

/// x = m · 2^n for a normal x > 0, m in [√½, √2); down = 2^−n.
template <class V>
struct Split {
  V m, n, down;
};
HWY_INLINE Split<Pack> split_exponent(const Pack& x) {
  const hn::RebindToSigned<Tag> di;
  Split<Pack> r;
  for (int i = 0; i < kUnroll; ++i) {
    const auto bits = hn::BitCast(di, x.v[i]);
    const auto n = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
    const auto up = hn::ShiftLeft<23>(n);
    r.m.v[i] = hn::BitCast(Tag(), hn::Sub(bits, up));
    r.n.v[i] = hn::ConvertTo(Tag(), n);
    r.down.v[i] = hn::BitCast(Tag(), hn::Sub(hn::Set(di, 0x3f800000), up));
  }
  return r;
}

/// The lanes where m, in their order, first; behind them: anything. Highway's own for AVX2 has its table of orders on
/// the stack, copied there at every call.
#if HWY_TARGET == HWY_AVX2
struct Orders {
  alignas(64) std::uint8_t lane[256][8] = {};
  constexpr Orders() {
    for (unsigned bits = 0; bits < 256; ++bits) {
      int n = 0;
      for (unsigned i = 0; i < 8; ++i) {
        if ((bits >> i & 1) != 0) lane[bits][n++] = static_cast<std::uint8_t>(i);
      }
    }
  }
};
inline constexpr Orders kOrders;
HWY_INLINE Vec to_the_front(const Vec& v, const VecMask& m) {
  static_assert(kVecLanes == 8);
  const hn::RebindToSigned<Tag> di;
  const hn::Rebind<std::uint8_t, Tag> du8;
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag(), m, bits);
  return hn::TableLookupLanes(v, hn::IndicesFromVec(Tag(), hn::PromoteTo(di, hn::Load(du8, kOrders.lane[bits[0]]))));
}
#else
HWY_INLINE Vec to_the_front(const Vec& v, const VecMask& m) { return hn::Compress(v, m); }
#endif

/// How loops step over micro-tiles of 16 cells: kMicros whole ones at a time.
struct Lanes {
  using V = Pack;
  using M = PackMask;
  static constexpr int kLanes = kVecLanes * kUnroll;
  static constexpr int kMicros = kLanes / 16;
  static constexpr int kPerMicro = 16 / kVecLanes;  // vectors in one micro-tile
  static_assert(kMicros >= 1 && kMicros * 16 == kLanes);

  static HWY_INLINE V load(const float* const* micro, int) {
    V r;
    for (int m = 0; m < kMicros; ++m) {
      for (int p = 0; p < kPerMicro; ++p) r.v[m * kPerMicro + p] = hn::Load(Tag(), micro[m] + p * kVecLanes);
    }
    return r;
  }
  /// Masked-out lanes keep what they hold.
  static HWY_INLINE void store(float* const* micro, int, const M& k, const V& v) {
    for (int m = 0; m < kMicros; ++m) {
      for (int p = 0; p < kPerMicro; ++p) {
        const int i = m * kPerMicro + p;
        float* at = micro[m] + p * kVecLanes;
        hn::Store(hn::IfThenElse(k.v[i], v.v[i], hn::Load(Tag(), at)), Tag(), at);
      }
    }
  }
  static HWY_INLINE void store_all(float* const* micro, int, const V& v) {
    for (int i = 0; i < kUnroll; ++i) hn::Store(v.v[i], Tag(), micro[i / kPerMicro] + i % kPerMicro * kVecLanes);
  }
  /// A number of each micro-tile of the step, for all its cells.
  static HWY_INLINE V spread(const float* per_micro) {
    V r;
    for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Set(Tag(), per_micro[i / kPerMicro]);
    return r;
  }
  /// Column and row of a cell within its micro-tile.
  static HWY_INLINE V column(int) {
    alignas(64) static constexpr float kColumn[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    return repeat(kColumn);
  }
  static HWY_INLINE V row(int) {
    alignas(64) static constexpr float kRow[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    return repeat(kRow);
  }
  /// Sixteen numbers, the same for every micro-tile.
  static HWY_INLINE V repeat(const float* sixteen, int = 0) {
    V r;
    for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Load(Tag(), sixteen + i % kPerMicro * kVecLanes);
    return r;
  }
  static constexpr int kWindow = 2 * kVecLanes;
  /// Of each micro-tile of the step kWindow floats: the one at `place`, a whole number within [0, kWindow). Two
  /// permutations instead of a gather.
  static HWY_INLINE V window(const float* const* of_micro, const V& place) {
    const hn::RebindToSigned<Tag> di;
    V r;
    for (int i = 0; i < kUnroll; ++i) {
      const float* at = of_micro[i / kPerMicro];
      const auto lane = hn::And(hn::ConvertTo(di, place.v[i]), hn::Set(di, kVecLanes - 1));
      const auto index = hn::IndicesFromVec(Tag(), lane);
      const Vec low = hn::TableLookupLanes(hn::LoadU(Tag(), at), index);
      const Vec high = hn::TableLookupLanes(hn::LoadU(Tag(), at + kVecLanes), index);
      r.v[i] = hn::IfThenElse(hn::Ge(place.v[i], hn::Set(Tag(), kVecLanes)), high, low);
    }
    return r;
  }
  /// The numbers where m, one after the other; answers how many. May write kVecLanes floats beyond them.
  static HWY_INLINE int append(float* to, const M& m, const V& v) {
    std::size_t n = 0;
    for (int i = 0; i < kUnroll; ++i) {
      hn::StoreU(to_the_front(v.v[i], m.v[i]), Tag(), to + n);
      n += hn::CountTrue(Tag(), m.v[i]);
    }
    return static_cast<int>(n);
  }
  static HWY_INLINE V load_flat(const float* p) {
    V r;
    for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::LoadU(Tag(), p + i * kVecLanes);
    return r;
  }
  static HWY_INLINE void store_flat(float* p, const V& v) {
    for (int i = 0; i < kUnroll; ++i) hn::StoreU(v.v[i], Tag(), p + i * kVecLanes);
  }
  static HWY_INLINE int count(const M& m) {
    std::size_t n = 0;
    for (int i = 0; i < kUnroll; ++i) n += hn::CountTrue(Tag(), m.v[i]);
    return static_cast<int>(n);
  }
  static HWY_INLINE std::uint64_t bits(const M& m) {
    std::uint64_t all = 0;
    for (int i = 0; i < kUnroll; ++i) {
      std::uint8_t raw[8] = {};
      hn::StoreMaskBits(Tag(), m.v[i], raw);
      const std::uint64_t word = static_cast<std::uint64_t>(raw[0]) | (static_cast<std::uint64_t>(raw[1]) << 8);
      all |= word << (i * kVecLanes);
    }
    return all;
  }
  static HWY_INLINE bool any(const M& m) {
    VecMask r = m.v[0];
    for (int i = 1; i < kUnroll; ++i) r = hn::Or(r, m.v[i]);
    return !hn::AllFalse(Tag(), r);
  }
  static HWY_INLINE float reduce_max(const V& v) {
    Vec r = v.v[0];
    for (int i = 1; i < kUnroll; ++i) r = hn::Max(r, v.v[i]);
    return hn::GetLane(hn::MaxOfLanes(Tag(), r));
  }
  static HWY_INLINE V gather(const float* base, const V& index) {
    const hn::RebindToSigned<Tag> di;
    V r;
    for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::GatherIndex(Tag(), base, hn::ConvertTo(di, index.v[i]));
    return r;
  }
  /// High and low 16 bits of the words at base[index], as numbers.
  static HWY_INLINE void gather_halves(const std::uint32_t* base, const V& index, V& high, V& low) {
    const hn::RebindToSigned<Tag> di;
    for (int i = 0; i < kUnroll; ++i) {
      const auto word = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(base), hn::ConvertTo(di, index.v[i]));
      const hn::RebindToUnsigned<Tag> du;
      high.v[i] = hn::ConvertTo(Tag(), hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, word))));
      low.v[i] = hn::ConvertTo(Tag(), hn::And(word, hn::Set(di, 0xffff)));
    }
  }
  static HWY_INLINE V floor(const V& x) {
    V r;
    for (int i = 0; i < kUnroll; ++i) r.v[i] = hn::Floor(x.v[i]);
    return r;
  }
};

EVIGRID_CELL_END
