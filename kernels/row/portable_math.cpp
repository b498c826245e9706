// SPDX-License-Identifier: Apache-2.0
#include "kernels/row/portable_math.hpp"

#include <cmath>

#include "kernels/cell/lane_scalar.hpp"
// After the lanes.
#include "kernels/cell/fade.hpp"

namespace evigrid::kernels {

SinCos portable_sincos(double angle) noexcept {
  // Cody–Waite: angle − n·π/2 with π/2 in three parts.
  const double n = std::nearbyint(angle * 0.63661977236758134308);
  double r = std::fma(-n, 1.57079632679489655800e+00, angle);
  r = std::fma(-n, 6.12323399573676603587e-17, r);
  r = std::fma(-n, -1.49738490485916983e-33, r);
  const double r2 = r * r;
  double s = 0, c = 0;
  for (int k = 10; k >= 1; --k) {
    s = (1 + s) * (-r2 / ((2.0 * k) * (2.0 * k + 1)));
    c = (1 + c) * (-r2 / ((2.0 * k - 1) * (2.0 * k)));
  }
  const double sine = r + r * s, cosine = 1 + c;
  switch (static_cast<long long>(n) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double portable_asin(double x) noexcept {
  // Series in x; converges to 1e-16 within 120 terms for |x| ≤ 0.8.
  double term = x, sum = x;
  for (int k = 1; k < 200; ++k) {
    term *= x * x * (2.0 * k - 1) / (2.0 * k);
    sum += term / (2.0 * k + 1);
  }
  return sum;
}

double portable_exp(double x) noexcept { return scalar::exponential_in_double(x); }

float portable_share_left(std::int64_t stamp_ns, float tau_s, std::int64_t now_ns) noexcept {
  return scalar::share_left(stamp_ns, tau_s, now_ns);
}

double portable_tanh(double x) noexcept {
  const double e = portable_exp(2 * x);
  return (e - 1) / (e + 1);
}

double portable_log(double x) noexcept {
  if (!(x > 0)) return -HUGE_VAL;
  int n = 0;
  double m = std::frexp(x, &n);  // exact; m in [½, 1)
  if (m < 0.70710678118654752440) m *= 2, --n;
  const double s = (m - 1) / (m + 1), s2 = s * s;  // ln m = 2 artanh s, |s| ≤ 0.172
  double sum = 0;
  for (int k = 23; k >= 3; k -= 2) sum = (1.0 / k + sum) * s2;
  const double ln = 2 * s + 2 * s * sum;
  return std::fma(n, 6.93147180559945286227e-01, std::fma(n, 2.31904681384629955842e-17, ln));
}

}  // namespace evigrid::kernels
