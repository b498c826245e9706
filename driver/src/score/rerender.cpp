// SPDX-License-Identifier: Apache-2.0
#include "score/rerender.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "score/score.hpp"

namespace evigrid::driver {
namespace {

class Prediction {
 public:
  explicit Prediction(const Layers& map) : map_(map), occupied_(map.cells()) {
    for (std::size_t i = 0; i < occupied_.size(); ++i) {
      occupied_[i] = decide(map.e()[i], map.o()[i], map.u()[i]) == Decision::occupied;
      if (!occupied_[i]) continue;
      const auto x = static_cast<std::int64_t>(i) % map.rect.width, y = static_cast<std::int64_t>(i) / map.rect.width;
      centres_.push_back({(static_cast<double>(map.rect.x + x) + 0.5) * map.cell_m,
                          (static_cast<double>(map.rect.y + y) + 0.5) * map.cell_m});
    }
  }
  [[nodiscard]] double cone(const Pose2& at, const Sensor& s) const {
    const double c = std::cos(at.yaw_rad), n = std::sin(at.yaw_rad), wide = std::cos(s.aperture_rad / 2);
    double best = s.max_range_m * s.max_range_m;
    bool any = false;
    for (const auto& [x, y] : centres_) {
      const double dx = x - at.x_m, dy = y - at.y_m, square = dx * dx + dy * dy;
      if (square > best || square < s.min_range_m * s.min_range_m) continue;
      if (c * dx + n * dy < wide * std::sqrt(square)) continue;
      best = square, any = true;
    }
    return any ? std::sqrt(best) : INFINITY;
  }
  [[nodiscard]] double ray(const Pose2& at, double bearing_rad, const Sensor& s) const {
    const double c = std::cos(at.yaw_rad + bearing_rad), n = std::sin(at.yaw_rad + bearing_rad);
    for (double d = s.min_range_m; d <= s.max_range_m; d += map_.cell_m / 4) {
      const auto x = static_cast<std::int64_t>(std::floor((at.x_m + d * c) / map_.cell_m)) - map_.rect.x;
      const auto y = static_cast<std::int64_t>(std::floor((at.y_m + d * n) / map_.cell_m)) - map_.rect.y;
      if (x < 0 || y < 0 || x >= map_.rect.width || y >= map_.rect.height) continue;
      if (occupied_[static_cast<std::size_t>(y * map_.rect.width + x)]) return d;
    }
    return INFINITY;
  }

 private:
  const Layers& map_;
  std::vector<bool> occupied_;
  std::vector<std::pair<double, double>> centres_;
};

}  // namespace

Rerendered rerender(const Layers& map, const Log& log, std::size_t most) {
  const Prediction world(map);
  const std::size_t every = std::max<std::size_t>(1, log.ranges_m.size() / std::max<std::size_t>(most, 1));
  Rerendered out;
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < log.scans.size(); i += every) {
    const LogScan& scan = log.scans[i];
    for (std::size_t r = scan.first; r < scan.first + scan.count; ++r) {
      const LogReading& reading = log.readings[r];
      const Sensor& s = log.sensors[reading.sensor].sensor;
      const Pose2 at = compose(scan.T_map_robot, s.T_robot_sensor);
      if (!(std::isfinite(at.x_m) && std::isfinite(at.y_m) && std::isfinite(at.yaw_rad))) continue;
      for (std::size_t b = 0; b < reading.count; ++b) {
        const double range_m = static_cast<double>(log.ranges_m[reading.first + b]);
        if (!(range_m >= s.min_range_m && range_m <= s.max_range_m && range_m < s.no_return_m)) continue;
        ++out.readings;
        const double predicted_m = s.model == Model::beam
                                       ? world.ray(at, s.first_beam_rad + static_cast<double>(b) * s.beam_step_rad, s)
                                       : world.cone(at, s);
        if (std::isfinite(predicted_m)) {
          errors_m.push_back(std::abs(predicted_m - range_m));
        } else {
          ++out.silent;
        }
      }
    }
  }
  out.median_m = out.mean_m = std::numeric_limits<double>::quiet_NaN();
  if (errors_m.empty()) return out;
  const auto middle = errors_m.begin() + static_cast<std::ptrdiff_t>(errors_m.size() / 2);
  std::nth_element(errors_m.begin(), middle, errors_m.end());
  out.median_m = *middle;
  out.mean_m = 0;
  for (const double e : errors_m) out.mean_m += e / static_cast<double>(errors_m.size());
  return out;
}

}  // namespace evigrid::driver
