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

namespace {

double square(double t) { return t * t; }

double lambda_of(EdgeAngles m) {
  const double half_aperture = (m.left_rad + m.right_rad) / 2, off_axis = (m.left_rad - m.right_rad) / 2;
  return (half_aperture - off_axis) * (half_aperture + off_axis) / square(half_aperture);
}

/// γ(θ)·ρ(d) of chapter 14, eq. (14.11) and (14.12).
double believed(const Along& at, double rho_v_m, EdgeAngles m) {
  const double off_axis = std::fabs(m.left_rad - m.right_rad) / 2;
  return (1 - square(off_axis) / 2) * (1 - (1 + std::tanh(2 * (at.d * at.cell_m - rho_v_m))) / 2);
}

double empty_part(const Along& at, double k) {
  if (at.d < at.range - at.width) return k;
  return at.d < at.range ? k * square((at.range - at.d) / at.width) : 0;
}
double occupied_part(const Along& at, double k) {
  if (at.d < at.range - at.width || at.d >= at.range + at.width) return 0;
  return k * (at.range + at.width - at.d) * (at.d - at.range + at.width) / square(at.width);
}

}  // namespace

Source oriolo1997(const evigrid::Oriolo1997& p, const Along& at, EdgeAngles m) {
  const double share = believed(at, p.rho_v_m, m);
  const double e = share * empty_part(at, p.k_empty), o = share * occupied_part(at, p.k_occupied);
  return {e, o, 0, 1 - e - o};
}

Source fuzzy(const evigrid::Fuzzy& p, const Along& at, EdgeAngles m) {
  const double share = believed(at, p.rho_v_m, m);
  double occupied = occupied_part(at, p.k_occupied);
  if (p.as_printed) {
    occupied = p.k_occupied;
    if (at.d >= at.range - at.width) occupied *= square((at.range - at.d) / at.width);
    if (at.d >= at.range + at.width) occupied = 0;
  }
  const double empty = share * empty_part(at, p.k_empty);
  return {empty, share * occupied, 0, std::max(0.0, 1 - empty - share * occupied)};
}

Source probability(const evigrid::Probability& p, const Along& at, EdgeAngles m) {
  const double share = believed(at, p.rho_v_m, m), a = (at.d - at.range) / at.width;
  double occupied = 0.5;
  if (a < -2) {
    occupied = (1 - share) / 2;
  } else if (a < -1) {
    occupied = (1 - share * (1 - square(2 + a))) / 2;
  } else if (at.d < at.range + at.width) {
    occupied = (1 + share * (1 - square(a))) / 2;
  }
  return {1 - occupied, occupied, 0, 0};
}

Source li2006(const evigrid::Li2006& p, const Along& at, EdgeAngles m) {
  const double d = at.d * at.cell_m, range = at.range * at.cell_m, epsilon = at.width * at.cell_m;
  Source s{0, std::exp(-3 * p.rho_v * square(d - range)), 0, 0};
  if (at.d <= at.range) {
    s.x = 1 - square(at.d / at.range);
    s.z = std::max(0.0, 1 - square(2 * (d - range + 2 * epsilon) / range));
  }
  if (at.d >= at.range) s.v = std::tanh(2 * (d - range));
  const double sum = s.x + s.y + s.z + s.v;
  return discount({s.x / sum, s.y / sum, s.z / sum, s.v / sum}, p.discount_by_lambda ? lambda_of(m) : 1);
}

Source moravec1985(const Along& at, EdgeAngles m) {
  const double lambda = lambda_of(m), border = at.range - at.width, depth = border - at.nearest;
  const double aperture = m.left_rad + m.right_rad, in_arc = 2 * aperture / 3 * (4 * at.width * at.range / 3);
  Source s{0, 0, 0, 0, true};
  if (at.d < border && depth > 0) s.x = lambda * (1 - square((at.d - at.nearest) / depth));
  if (at.d >= border)
    s.y = lambda * (at.range + at.width - at.d) * (at.d - border) / square(at.width) / std::max(1.0, in_arc);
  s.v = 1 - s.x - s.y;
  return s;
}

Source cone_model(const evigrid::Sensor& s, const Along& at, EdgeAngles m, Zone zone) {
  switch (s.model) {
    case evigrid::Model::hughes1992:
      return hughes1992(s.hughes, at.d * at.cell_m, m, zone);
    case evigrid::Model::li2014:
      return li2014(s.li, at.range * at.cell_m, at.d * at.cell_m, m);
    case evigrid::Model::oriolo1997:
      return oriolo1997(s.oriolo, at, m);
    case evigrid::Model::li2006:
      return li2006(s.li2006, at, m);
    case evigrid::Model::probability:
      return probability(s.probability, at, m);
    case evigrid::Model::fuzzy:
      return fuzzy(s.fuzzy, at, m);
    default:
      return moravec1985(at, m);
  }
}

Source discount(const Source& s, double reliability) {
  Source out{s.x * reliability, s.y * reliability, s.z * reliability, 0, s.yields};
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
  return {m[1], m[2], m[0], m[3], s.yields};
}

}  // namespace oracle
