// SPDX-License-Identifier: Apache-2.0
// "One number" that counts: the kernels' own text, run once on it, says how many operations an update of a cell costs.
// An addition, subtraction, product, quotient, root, minimum or maximum is one flop, a fused multiply-add two;
// compares, selects and moves of bits are none.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#define EVIGRID_FN inline
#define EVIGRID_LAMBDA
#define EVIGRID_CELL_BEGIN namespace evigrid::kernels::counted {
#define EVIGRID_CELL_END }

EVIGRID_CELL_BEGIN

struct Count {
  double flop = 0, slow = 0;  ///< slow: quotients and roots among them
};
inline Count counter;

struct Number {
  float v = 0;
  Number() = default;
  explicit Number(float x) : v(x) {}
};
inline Number counted(float v, double flop, double slow = 0) {
  counter.flop += flop, counter.slow += slow;
  return Number(v);
}
inline Number operator+(Number a, Number b) { return counted(a.v + b.v, 1); }
inline Number operator-(Number a, Number b) { return counted(a.v - b.v, 1); }
inline Number operator*(Number a, Number b) { return counted(a.v * b.v, 1); }
inline Number operator/(Number a, Number b) { return counted(a.v / b.v, 1, 1); }
inline bool operator<(Number a, Number b) { return a.v < b.v; }
inline bool operator>(Number a, Number b) { return a.v > b.v; }
inline bool operator<=(Number a, Number b) { return a.v <= b.v; }
inline bool operator>=(Number a, Number b) { return a.v >= b.v; }
inline bool operator==(Number a, Number b) { return a.v == b.v; }
inline Number mul_add(Number a, Number b, Number c) { return counted(std::fma(a.v, b.v, c.v), 2); }
inline Number neg_mul_add(Number a, Number b, Number c) { return counted(std::fma(-a.v, b.v, c.v), 2); }
inline Number root(Number a) { return counted(std::sqrt(a.v), 1, 1); }
inline Number max_of(Number a, Number b) { return counted(a.v > b.v ? a.v : b.v, 1); }
inline Number min_of(Number a, Number b) { return counted(a.v < b.v ? a.v : b.v, 1); }
inline Number select(bool m, Number a, Number b) { return m ? a : b; }
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline Number scale_by_magic(Number p, Number magic) {
  return Number(
      std::bit_cast<float>(std::bit_cast<std::uint32_t>(p.v) + (std::bit_cast<std::uint32_t>(magic.v) << 23)));
}

/// One cell a step.
struct Lanes {
  using V = Number;
  static constexpr int kMicros = 1;
  static V spread(const float* per_micro) { return Number(*per_micro); }
  static V repeat(const float* sixteen, int part) { return Number(sixteen[part]); }
};

EVIGRID_CELL_END
