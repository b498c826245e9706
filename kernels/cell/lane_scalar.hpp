// SPDX-License-Identifier: Apache-2.0
// "One number" of the scalar table: float or double. Only what IEEE 754 rounds correctly, plus explicit fma, so that
// every table gives the same bits. std::fma is fused in hardware or exact in software: same result.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#define EVIGRID_FN inline
#define EVIGRID_CELL_BEGIN namespace evigrid::kernels::scalar {
#define EVIGRID_CELL_END }

EVIGRID_CELL_BEGIN

inline float mul_add(float a, float b, float c) { return std::fma(a, b, c); }
inline double mul_add(double a, double b, double c) { return std::fma(a, b, c); }
inline float neg_mul_add(float a, float b, float c) { return std::fma(-a, b, c); }
inline double neg_mul_add(double a, double b, double c) { return std::fma(-a, b, c); }
inline float root(float a) { return std::sqrt(a); }
inline double root(double a) { return std::sqrt(a); }
template <class T>
inline T select(bool m, T a, T b) {
  return m ? a : b;
}
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
template <class T>
inline T max_of(T a, T b) {
  return a > b ? a : b;
}
template <class T>
inline T min_of(T a, T b) {
  return a < b ? a : b;
}
/// p · 2^n for the integer n whose bits stand in the low end of `magic` (see exp2_poly).
inline float scale_by_magic(float p, float magic) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(p) + (std::bit_cast<std::uint32_t>(magic) << 23));
}

/// How loops step over a micro-tile of 16 cells: one cell at a time.
struct Lanes {
  using V = float;
  using M = bool;
  static constexpr int kLanes = 1;   // cells per step
  static constexpr int kMicros = 1;  // micro-tiles per step
  static V load(const float* const* micro, int part) { return micro[0][part]; }
  static void store(float* const* micro, int part, M m, V v) {
    if (m) micro[0][part] = v;
  }
  /// One value for each micro-tile of the step, and sixteen for the cells of each.
  static V spread(const float* values, int) { return *values; }
  static V repeat(const float* sixteen, int part) { return sixteen[part]; }
  static V load_flat(const float* p) { return *p; }
  static void store_flat(float* p, V v) { *p = v; }
  static int count(M m) { return m ? 1 : 0; }
  static bool any(M m) { return m; }
  static std::uint64_t bits(M m) { return m ? 1 : 0; }
  static float reduce_max(V v) { return v; }
  static V gather(const float* base, V index) { return base[static_cast<int>(index)]; }
  /// High and low 16 bits of the word at base[index], as numbers.
  static void gather_halves(const std::uint32_t* base, V index, V& high, V& low) {
    const std::uint32_t word = base[static_cast<int>(index)];
    high = static_cast<float>(word >> 16);
    low = static_cast<float>(word & 0xffffu);
  }
  /// Rounds towards minus infinity; |x| < 2^22.
  static V floor(V x) { return std::floor(x); }
};

EVIGRID_CELL_END
