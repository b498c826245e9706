// SPDX-License-Identifier: Apache-2.0
// Polynomials of ours, fitted by Remez; libm's differ between processors. Errors: relative for 2^y, in resulting mass
// for the logarithm (docs/maths.md states the bound on masses, a test holds it).
#pragma once

EVIGRID_CELL_BEGIN

/// 2^y for −126 < y < 127, relative error of the polynomial 7.5e-8, in float arithmetic 2.2e-7. The magic constant leaves round(y) in the low bits of the sum.
template <class V>
EVIGRID_FN V exp2_poly(const V& y) {
  const V magic(12582912.0f);
  const V n = y + magic, f = y - (n - magic);
  V p = mul_add(V(0.00132764725f), f, V(0.00967554096f));
  p = mul_add(p, f, V(0.0555071309f));
  p = mul_add(p, f, V(0.240221202f));
  p = mul_add(p, f, V(0.693146944f));
  p = mul_add(p, f, V(1.00000012f));
  return scale_by_magic(p, n);
}

/// √(80·log2 e)·ln r for t = r − 1.1 within [−0.463, 0.516]: the exponent of li2014's paradoxical mass at ρC = 80.
/// Fitted with the weight that the mass 2^(−l²) gives to an error of l: the mass is right to 1.7e-7. Beyond that range
/// the mass is below 5e-7 and the argument is clamped by the caller.
template <class V>
EVIGRID_FN V scaled_log(const V& t) {
  V p = mul_add(V(-0.8522990942f), t, V(1.009788990f));
  p = mul_add(p, t, V(-0.9618414640f));
  p = mul_add(p, t, V(1.312021852f));
  p = mul_add(p, t, V(-1.838957906f));
  p = mul_add(p, t, V(2.690870762f));
  p = mul_add(p, t, V(-4.439251900f));
  p = mul_add(p, t, V(9.766512871f));
  return mul_add(p, t, V(1.023932934f));
}

/// e^x and e^x − 1 for |x| ≤ 80; 1 and 0 exactly at 0. Errors relative to each: 1.1e-7 and 2.6e-7.
template <class V>
struct Exponential {
  V value, less_one;
};
template <class V>
EVIGRID_FN Exponential<V> exponential(const V& x) {
  const V magic(12582912.0f), one(1.0f);
  const V shifted = mul_add(x, V(1.44269504f), magic), n = shifted - magic;
  const V r = neg_mul_add(n, V(-1.90465421e-9f), neg_mul_add(n, V(0.693147182f), x));
  V q = mul_add(V(0.00138825225f), r, V(0.00836651493f));
  q = mul_add(q, r, V(0.0416672006f));
  q = mul_add(q, r, V(0.166665435f));
  q = mul_add(q, r, V(0.49999997f));
  const V p = mul_add(r * r, q, r), power = scale_by_magic(one, shifted);  // e^r − 1, 2^n
  return {mul_add(power, p, power), mul_add(power, p, power - one)};
}

/// A logarithm in two parts, so that a sum of many like ones does not add up the rounding of one float: large is a
/// multiple of 11/16, exactly, |small| < ½ for arguments below 2^20.
template <class V>
struct LogParts {
  V large, small;
};
/// ln(1 + x) for 0 ≤ x < 2^100, absolute error 5e-8 and relative error 1.7e-7; 0 exactly at 0.
template <class V>
EVIGRID_FN LogParts<V> log_one_plus_parts(const V& x) {
  const V one(1.0f);
  const V w = one + x, added = w - one, lost = (one - (w - added)) + (x - added);  // 1 + x = w + lost
  const auto s = split_exponent(w);
  const V f = mul_add(lost, s.down, s.m - one);
  V q = mul_add(V(0.087348409f), f, V(-0.143075213f));
  q = mul_add(q, f, V(0.149179742f));
  q = mul_add(q, f, V(-0.165705085f));
  q = mul_add(q, f, V(0.199620724f));
  q = mul_add(q, f, V(-0.250017554f));
  q = mul_add(q, f, V(0.333339512f));
  q = mul_add(q, f, V(-0.499999911f));
  const V p = mul_add(f * f, q, f);
  return {s.n * V(0.6875f), mul_add(s.n, V(0.00564718056f), p)};  // ln 2 = 11/16 + 0.0056…
}
template <class V>
EVIGRID_FN V log_one_plus(const V& x) {
  const LogParts<V> l = log_one_plus_parts(x);
  return l.large + l.small;
}

/// c[0] + c[1]·x + c[2]·x² + c[3]·x³: the fits made once per sensor.
template <class V>
EVIGRID_FN V cubic(const float (&c)[4], const V& x) {
  return mul_add(mul_add(mul_add(V(c[3]), x, V(c[2])), x, V(c[1])), x, V(c[0]));
}

/// Angle of (x, y) in (−π, π], error at most 5.19e-7 rad: finds a candidate beam, exact tests decide (fan_exact.hpp).
template <class V>
EVIGRID_FN V coarse_angle(const V& x, const V& y) {
  const V zero(0.0f);
  const V ax = max_of(x, zero - x), ay = max_of(y, zero - y);
  const V z = min_of(ax, ay) / max_of(max_of(ax, ay), V(1e-6f));
  const V t = z * z;
  V p = mul_add(V(0.00681178970f), t, V(-0.0336042084f));
  p = mul_add(p, t, V(0.0796236545f));
  p = mul_add(p, t, V(-0.132333413f));
  p = mul_add(p, t, V(0.198078156f));
  p = mul_add(p, t, V(-0.333173692f));
  p = mul_add(p, t, V(0.999996126f));
  V a = p * z;
  a = select(ax < ay, V(1.57079633f) - a, a);
  a = select(x < zero, V(3.14159265f) - a, a);
  return select(y < zero, zero - a, a);
}

EVIGRID_CELL_END
