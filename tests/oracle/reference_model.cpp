// SPDX-License-Identifier: Apache-2.0
#include "tests/oracle/reference_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oracle {

Source hughes1992(const evigrid::Hughes1992& p, double d_m, EdgeAngles m, Zone zone) {
  const double half_aperture = (m.left_rad + m.right_rad) / 2;
  const double off_axis = std::fabs(m.left_rad - m.right_rad) / 2;
  const double by_range = (p.r_max_m - d_m) / p.r_max_m;
  const double by_angle = (half_aperture - off_axis) / half_aperture;
  const double f = std::clamp((by_range + by_angle) / 2, 0.0, 1.0);
  Source s;
  if (zone == Zone::empty) s.x = f;
  if (zone == Zone::occupied) s.y = f * p.max_occupied;
  s.v = 1 - s.x - s.y;
  return s;
}

Source li2014(const evigrid::Li2014& p, double range_m, double d_m, EdgeAngles m) {
  const double half_aperture = (m.left_rad + m.right_rad) / 2;
  const double lambda = m.left_rad * m.right_rad / (half_aperture * half_aperture);
  const double epsilon = p.epsilon_ratio * range_m;
  const double spread_e = range_m * p.rho_e;
  const double beta =
      std::log(p.rho_e * std::sqrt(range_m * range_m * range_m) / (p.rho_e * std::sqrt(range_m) + p.rho_o));
  const double off_range = d_m - range_m, off_beta = std::log(d_m) - beta;
  Source s;
  s.x = (1 - lambda / 2) * std::exp(-d_m * d_m / (2 * spread_e * spread_e));
  s.y = lambda * std::exp(-off_range * off_range / (2 * range_m * p.rho_o * p.rho_o));
  s.z = std::exp(-p.rho_c * off_beta * off_beta);
  s.v = 0;
  if (d_m >= range_m + epsilon) s.v = (1 - lambda) * std::tanh(p.rho_i * (d_m - (range_m + epsilon)) / range_m);
  const double sum = s.x + s.y + s.z + s.v;
  return {s.x / sum, s.y / sum, s.z / sum, s.v / sum};
}

Source beam(const evigrid::Sensor& sensor, double d_m, Zone zone) {
  const double fall = 1 - d_m / (2 * sensor.max_range_m);
  Source s;
  if (zone == Zone::empty) s.x = sensor.beam.empty * fall;
  if (zone == Zone::occupied) s.y = sensor.beam.occupied * fall;
  s.v = 1 - s.x - s.y;
  return s;
}

Source discount(const Source& s, double reliability) {
  Source out{s.x * reliability, s.y * reliability, s.z * reliability, 0};
  // v + (1 − ρ)(x + y + z), which is 1 − x − y − z after the discount, without cancellation.
  out.v = s.v + (1 - reliability) * (s.x + s.y + s.z);
  return out;
}

Source contextual(const Source& s, double if_empty, double if_occupied) {
  // Bits: 1 empty, 2 occupied; 0 is what lies on both at once.
  double m[4] = {s.z, s.x, s.y, s.v};
  for (const auto& [hypothesis, reliability] : {std::pair{1, if_empty}, std::pair{2, if_occupied}}) {
    double joined[4] = {};
    for (int a = 0; a < 4; ++a) {
      joined[a] += m[a] * reliability;
      joined[a | hypothesis] += m[a] * (1 - reliability);
    }
    std::copy(joined, joined + 4, m);
  }
  return {m[1], m[2], m[0], m[3]};
}

}  // namespace oracle
