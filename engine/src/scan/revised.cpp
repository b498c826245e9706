// SPDX-License-Identifier: Apache-2.0
#include "scan/revised.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "evigrid/combine.hpp"
#include "evigrid/revision.hpp"

namespace evigrid {
namespace {

constexpr int kCells = kernels::kMicroCells;

/// 1/(1 + e^−t) by sums, products and one division, so that its bits are the same everywhere: 2^n·e^r, |r| ≤ ln 2/2,
/// e^r by its series, right to 2e-16.
double logistic(double t) noexcept {
  constexpr double kMost = 700;  // e^700 is still finite
  const double x = std::clamp(-t, -kMost, kMost);
  constexpr double kMagic = 6755399441055744;  // 1.5·2^52: adding it rounds to a whole number
  const double n = (x * 1.44269504088896340736 + kMagic) - kMagic;
  const double r = (x - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10;
  constexpr double kInverse[] = {1.0 / 13, 1.0 / 12, 1.0 / 11, 1.0 / 10, 1.0 / 9, 1.0 / 8, 1.0 / 7,
                                 1.0 / 6,  1.0 / 5,  1.0 / 4,  1.0 / 3,  1.0 / 2, 1.0};
  double sum = 1;
  for (const double inverse : kInverse) sum = 1 + sum * (r * inverse);
  const auto power = std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023) << 52);
  return 1 / (1 + sum * power);
}

/// Σ w[i]·in[i] + w[N], in order.
template <std::size_t N>
double weighed(const double* w, const std::array<double, N>& in) noexcept {
  double sum = w[N];
  for (std::size_t i = 0; i < N; ++i) sum += w[i] * in[i];
  return sum;
}

}  // namespace

std::array<double, RevisionNetwork::kHidden> RevisionNetwork::hidden(const std::array<double, kIn>& in) const noexcept {
  std::array<double, kHidden> out{};
  for (std::size_t h = 0; h < kHidden; ++h) out[h] = logistic(weighed(weight.data() + h * (kIn + 1), in));
  return out;
}

std::array<double, RevisionNetwork::kOut> RevisionNetwork::raw(
    const std::array<double, kHidden>& hidden) const noexcept {
  std::array<double, kOut> out{};
  const double* const first = weight.data() + kHidden * (kIn + 1);
  for (std::size_t o = 0; o < kOut; ++o) out[o] = logistic(weighed(first + o * (kHidden + 1), hidden));
  return out;
}

ModelMass revise(const RevisionNetwork& network, const ModelMass& m) noexcept {
  const auto out = network.raw(network.hidden({m.e, m.o, m.u, m.c}));
  const double sum = (out[0] + out[1]) + (out[2] + out[3]);
  return {out[0] / sum, out[1] / sum, out[2] / sum, out[3] / sum};
}

const std::vector<Plane>& planes_of_revised() {
  static const std::vector<Plane> planes = planes_of({.rule = Rule::conjunctive, .keep_conflict = false});
  return planes;
}

void RevisedReading::revise(const Sensor& sensor, const MapParams& params, float* heard, std::size_t micros) {
  cells_.clear();
  for (std::size_t m = 0; m < micros; ++m) {
    float* const micro = heard + m * 4 * kCells;
    for (int i = 0; i < kCells; ++i) {
      const bool nothing = micro[i] == 0 && micro[kCells + i] == 0 && micro[3 * kCells + i] == 0;
      if (!nothing) cells_.push_back(micro + i);
    }
  }
  const std::size_t n = cells_.size();
  masses_.resize(9 * n);
  float* const zero = masses_.data();
  float *const one = zero + n, *const x = one + n, *const y = x + n, *const v = y + n, *const z = v + n,
               *const e = z + n, *const o = e + n, *const u = o + n;
  for (std::size_t i = 0; i < n; ++i) {
    const float* const c = cells_[i];
    const double sum = (static_cast<double>(c[0]) + c[kCells]) + (static_cast<double>(c[2 * kCells]) + c[3 * kCells]);
    const ModelMass r =
        evigrid::revise(*sensor.revision, {c[0] / sum, c[kCells] / sum, c[2 * kCells] / sum, c[3 * kCells] / sum});
    zero[i] = 0, one[i] = 1;
    x[i] = static_cast<float>(r.e), y[i] = static_cast<float>(r.o);
    v[i] = static_cast<float>(r.u), z[i] = static_cast<float>(r.c);
  }
  combine(params.rule, Planes<const float>{zero, zero, one}, Planes<const float>{x, y, v, z}, Planes<float>{e, o, u},
          static_cast<float*>(nullptr), n, params.kernel);
  for (std::size_t i = 0; i < n; ++i) {
    float* const c = cells_[i];
    c[0] = e[i], c[kCells] = o[i], c[2 * kCells] = u[i], c[3 * kCells] = 0;
  }
}

}  // namespace evigrid
