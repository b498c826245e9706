// SPDX-License-Identifier: Apache-2.0
#include "paper/five_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "evigrid/combine.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kReadings = 5;

struct Masses {
  double e = 0, o = 0, u = 1, c = 0;
};

/// Equations (14.6) to (14.10), divided by their sum and then discounted by λ.
Masses masses(const Sensor& s, double range_m, double d_m, double theta_rad) {
  const double eps = s.li2006.epsilon_m, behind = d_m - range_m;
  if (behind > eps) return {};
  const double e = behind <= 0 ? 1 - std::pow(d_m / range_m, 2) : 0;
  const double o = std::exp(-3 * s.li2006.rho_v * behind * behind);
  const double c = behind <= 0 ? std::max(0.0, 1 - std::pow(2 * (behind + 2 * eps) / range_m, 2)) : 0;
  const double u = behind > 0 ? std::tanh(2 * behind) : 0;
  const double share = (1 - std::pow(2 * theta_rad / s.aperture_rad, 2)) / (e + o + c + u);
  return {share * e, share * o, 1 - share * (e + o + c), share * c};
}

struct Cell {
  Masses mass{};
  double conflict = 0;
  std::array<Masses, kReadings> waiting{};
  std::size_t read = 0;
};

void fuse(Cell& cell, Rule rule) {
  for (const Masses& m : cell.waiting) {
    Masses next;
    double k = 0;
    combine(rule, Planes<const double>{&cell.mass.e, &cell.mass.o, &cell.mass.u, &cell.mass.c},
            Planes<const double>{&m.e, &m.o, &m.u, &m.c}, Planes<double>{&next.e, &next.o, &next.u, &next.c}, &k, 1);
    cell.mass = next;
    cell.conflict += k;
  }
}

}  // namespace

FiveReadings fuse_by_fives(const Log& log, Rule rule, double cell_m, const CellRect& rect) {
  std::vector<Cell> cells(static_cast<std::size_t>(rect.width * rect.height));
  for (const LogScan& scan : log.scans) {
    for (std::size_t r = scan.first; r < scan.first + scan.count; ++r) {
      const LogReading& reading = log.readings[r];
      const Sensor& sensor = log.sensors[reading.sensor].sensor;
      const double range_m = static_cast<double>(log.ranges_m[reading.first]);
      if (!(range_m >= sensor.min_range_m && range_m <= sensor.max_range_m)) continue;
      const Pose2 at = compose(scan.T_map_robot, sensor.T_robot_sensor);
      const double reach = range_m + sensor.li2006.epsilon_m;
      const auto low = [&](double x, std::int64_t from) {
        return std::max(from, static_cast<std::int64_t>(std::floor((x - reach) / cell_m)));
      };
      const auto high = [&](double x, std::int64_t to) {
        return std::min(to, static_cast<std::int64_t>(std::ceil((x + reach) / cell_m)));
      };
      for (std::int64_t y = low(at.y_m, rect.y); y < high(at.y_m, rect.y + rect.height); ++y) {
        for (std::int64_t x = low(at.x_m, rect.x); x < high(at.x_m, rect.x + rect.width); ++x) {
          const double dx = (static_cast<double>(x) + 0.5) * cell_m - at.x_m;
          const double dy = (static_cast<double>(y) + 0.5) * cell_m - at.y_m;
          const double theta = std::remainder(std::atan2(dy, dx) - at.yaw_rad, 2 * std::numbers::pi);
          const double d = std::hypot(dx, dy);
          if (std::abs(theta) > sensor.aperture_rad / 2 || d < sensor.min_range_m || d > reach) continue;
          const Masses m = masses(sensor, range_m, d, theta);
          if (m.u == 1) continue;
          Cell& cell = cells[static_cast<std::size_t>((y - rect.y) * rect.width + (x - rect.x))];
          cell.waiting[cell.read++ % kReadings] = m;
          if (cell.read % kReadings == 0) fuse(cell, rule);
        }
      }
    }
  }
  FiveReadings out;
  out.layers.rect = rect;
  out.layers.cell_m = cell_m;
  const std::size_t n = cells.size();
  out.layers.planes.resize(4 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Cell& cell = cells[i];
    const std::array plane{cell.mass.e, cell.mass.o, cell.mass.u, cell.conflict};
    for (std::size_t p = 0; p < plane.size(); ++p) out.layers.planes[p * n + i] = static_cast<float>(plane[p]);
    out.read.push_back(cell.read);
  }
  return out;
}

}  // namespace evigrid::driver
