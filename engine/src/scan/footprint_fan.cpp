// SPDX-License-Identifier: Apache-2.0
// Fans: a block or micro-tile is dropped when no beam that could cover it reaches it.
#include <algorithm>
#include <bit>
#include <cmath>

#include "scan/footprint.hpp"

namespace evigrid {
namespace {

/// atan2 to 1e-4 rad: only widens footprints.
float rough_angle(float y, float x) {
  const float ax = std::fabs(x), ay = std::fabs(y), z = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-6f), t = z * z;
  float a = z * (0.99997726f +
                 t * (-0.33262347f + t * (0.19354346f + t * (-0.11643287f + t * (0.05265332f - t * 0.01172120f)))));
  if (ax < ay) a = 1.57079633f - a;
  if (x < 0) a = 3.14159265f - a;
  return y < 0 ? -a : a;
}

/// May any beam touch a square of half diagonal `radius` around (x, y)?
bool reachable(const kernels::FanReading& q, const FanReach& reach, float x, float y, float radius) {
  const float d = std::sqrt(x * x + y * y);
  if (d > q.far + radius || d + radius < q.near) return false;
  if (d < 1.5f * radius) return true;
  const float s = radius / d, half = s * (1 + 0.3f * s * s) + 2e-3f;  // ≥ asin(s) for s ≤ 2/3
  const float far = reach.farthest(rough_angle(q.mid_cos * y - q.mid_sin * x, q.mid_cos * x + q.mid_sin * y), half);
  return far + q.half_width + radius + 0.01f >= d;
}

}  // namespace

void FanReach::build(const kernels::Fan& fan) {
  fan_ = &fan.reading;
  const std::size_t n = fan.range.size();
  levels_ = std::bit_width(n);
  table_.resize(static_cast<std::size_t>(levels_) * n);
  std::copy(fan.range.begin(), fan.range.end(), table_.begin());
  for (int l = 1; l < levels_; ++l) {
    const float* below = table_.data() + static_cast<std::size_t>(l - 1) * n;
    float* level = table_.data() + static_cast<std::size_t>(l) * n;
    const std::size_t half = std::size_t{1} << (l - 1);
    for (std::size_t i = 0; i < n; ++i) level[i] = i + half < n ? std::max(below[i], below[i + half]) : below[i];
  }
}

float FanReach::farthest(float angle_rad, float half_rad) const {
  const int n = fan_->beams;
  const float t = angle_rad * fan_->beams_per_rad + fan_->half_beams, h = half_rad * fan_->beams_per_rad + 1;
  // A wide fan can meet the square from both of its ends.
  if (angle_rad + half_rad > 3.14f || angle_rad - half_rad < -3.14f)
    return table_[static_cast<std::size_t>(levels_ - 1) * static_cast<std::size_t>(n)] > 0 ? fan_->far : -1;
  const int from = std::max(0, static_cast<int>(std::floor(t - h))),
            to = std::min(n - 1, static_cast<int>(std::floor(t + h)));
  if (to < from) return -1;
  const int level = std::bit_width(static_cast<unsigned>(to - from + 1)) - 1;
  const float* row = table_.data() + static_cast<std::size_t>(level) * static_cast<std::size_t>(n);
  return std::max(row[from], row[to + 1 - (1 << level)]);
}

void select_micros(const kernels::FanReading& q, const FanReach& reach, double x0, double y0, MicroList& out) {
  out.count = 0;
  const auto x = static_cast<float>(x0), y = static_cast<float>(y0);
  if (!reachable(q, reach, x + 31.5f, y + 31.5f, 44.6f)) return;
  bool block[4][4];
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      block[j][i] =
          reachable(q, reach, x + static_cast<float>(16 * i) + 7.5f, y + static_cast<float>(16 * j) + 7.5f, 10.7f);
    }
  }
  for (int j = 0; j < kernels::kMicrosPerSide; ++j) {
    for (int i = 0; i < kernels::kMicrosPerSide; ++i) {
      if (!block[j / 4][i / 4]) continue;
      if (reachable(q, reach, x + static_cast<float>(4 * i) + 1.5f, y + static_cast<float>(4 * j) + 1.5f, 2.2f)) {
        out.micro[static_cast<std::size_t>(out.count++)] = static_cast<std::uint8_t>(j * 16 + i);
      }
    }
  }
}

}  // namespace evigrid
