// SPDX-License-Identifier: Apache-2.0
// "One number" of the scalar table, and of one thread of a device (device/lane_device.hpp): float or double. Only what IEEE 754 rounds correctly, plus explicit fma, so that
// every table gives the same bits. std::fma is fused in hardware or exact in software: same result.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#ifndef EVIGRID_FN
#define EVIGRID_FN inline
#define EVIGRID_CELL_BEGIN namespace evigrid::kernels::scalar {
#define EVIGRID_CELL_END }
#endif

EVIGRID_CELL_BEGIN

EVIGRID_FN float mul_add(float a, float b, float c) { return std::fma(a, b, c); }
EVIGRID_FN double mul_add(double a, double b, double c) { return std::fma(a, b, c); }
EVIGRID_FN float neg_mul_add(float a, float b, float c) { return std::fma(-a, b, c); }
EVIGRID_FN double neg_mul_add(double a, double b, double c) { return std::fma(-a, b, c); }
EVIGRID_FN float magnitude(float a) { return std::fabs(a); }
EVIGRID_FN float root(float a) { return std::sqrt(a); }
EVIGRID_FN double root(double a) { return std::sqrt(a); }
template <class T>
EVIGRID_FN T select(bool m, T a, T b) {
  return m ? a : b;
}
EVIGRID_FN bool both(bool a, bool b) { return a && b; }
EVIGRID_FN bool either(bool a, bool b) { return a || b; }
template <class T>
EVIGRID_FN T max_of(T a, T b) {
  return a > b ? a : b;
}
template <class T>
EVIGRID_FN T min_of(T a, T b) {
  return a < b ? a : b;
}
/// p · 2^n for the integer n whose bits stand in the low end of `magic` (see exp2_poly).
EVIGRID_FN float scale_by_magic(float p, float magic) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(p) + (std::bit_cast<std::uint32_t>(magic) << 23));
}

/// x = m · 2^n for a normal x > 0, m in [√½, √2); down = 2^−n.
template <class V>
struct Split {
  V m, n, down;
};
EVIGRID_FN Split<float> split_exponent(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::int32_t n = static_cast<std::int32_t>(bits - 0x3f3504f3u) >> 23;
  const std::uint32_t up = static_cast<std::uint32_t>(n) << 23;
  return {std::bit_cast<float>(bits - up), static_cast<float>(n), std::bit_cast<float>(0x3f800000u - up)};
}

/// How loops step over a micro-tile of 16 cells: one cell at a time.
struct Lanes {
  using V = float;
  using M = bool;
  static constexpr int kLanes = 1;   // cells per step
  static constexpr int kMicros = 1;  // micro-tiles per step
  static EVIGRID_FN V load(const float* const* micro, int part) { return micro[0][part]; }
  static EVIGRID_FN void store(float* const* micro, int part, M m, V v) {
    if (m) micro[0][part] = v;
  }
  static EVIGRID_FN void store_all(float* const* micro, int part, V v) { micro[0][part] = v; }
  /// A number of each micro-tile of the step, for all its cells.
  static EVIGRID_FN V spread(const float* per_micro) { return per_micro[0]; }
  /// Sixteen numbers, the same for every micro-tile.
  static EVIGRID_FN V repeat(const float* sixteen, int part) { return sixteen[part]; }
  /// Column and row of a cell within its micro-tile.
  static EVIGRID_FN V column(int part) { return static_cast<float>(part % 4); }
  static EVIGRID_FN V row(int part) { return static_cast<float>(part / 4); }
  static constexpr int kWindow = 32;
  /// Of each micro-tile of the step kWindow floats: the one at `place`, a whole number within [0, kWindow).
  static EVIGRID_FN V window(const float* const* of_micro, V place) { return of_micro[0][static_cast<int>(place)]; }
  static EVIGRID_FN V load_flat(const float* p) { return *p; }
  static EVIGRID_FN void store_flat(float* p, V v) { *p = v; }
  static EVIGRID_FN V load_unorm16(const std::uint16_t* p) { return static_cast<float>(*p); }
  /// v + 2^23 ends in the nearest whole number, ties to even.
  static EVIGRID_FN void store_unorm16(std::uint16_t* p, V v) {
    *p = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(v + 8388608.0f));
  }
  static EVIGRID_FN int count(M m) { return m ? 1 : 0; }
  static EVIGRID_FN bool any(M m) { return m; }
  static EVIGRID_FN std::uint64_t bits(M m) { return m ? 1 : 0; }
  static EVIGRID_FN float reduce_max(V v) { return v; }
  /// The numbers where m, one after the other; answers how many. May write kLanes floats.
  static EVIGRID_FN int append(float* to, M m, V v) {
    *to = v;
    return m ? 1 : 0;
  }
  static EVIGRID_FN V gather(const float* base, V index) { return base[static_cast<int>(index)]; }
  /// High and low 16 bits of the word at base[index], as numbers.
  static EVIGRID_FN void gather_halves(const std::uint32_t* base, V index, V& high, V& low) {
    const std::uint32_t word = base[static_cast<int>(index)];
    high = static_cast<float>(word >> 16);
    low = static_cast<float>(word & 0xffffu);
  }
  /// Rounds towards minus infinity; |x| < 2^22.
  static EVIGRID_FN V floor(V x) { return std::floor(x); }
};

EVIGRID_CELL_END
