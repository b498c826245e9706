// SPDX-License-Identifier: Apache-2.0
// One point of a model, from the scalar functions that the map runs, but of lengths as they are and not on a lattice:
// there is no cell to decide on, and a rounded ε beside a point that is not rounded would give 1.00003 for 1.
#include <cmath>
#include <stdexcept>

#include "kernels/row/compile_cone.hpp"
#include "kernels/row/kernel_table.hpp"
#include "model_rows.hpp"
#include "params/table.hpp"
#include "scan/compiled.hpp"

namespace evigrid {

ModelMass evaluate(const Sensor& s, double range_m, double d_m, double theta_rad, double cell_m) {
  if (const auto errors = check(s); !errors.empty()) throw std::invalid_argument(describe(errors));
  if (!(range_m > 0) || !(d_m > 0) || !std::isfinite(range_m) || !std::isfinite(theta_rad)) return {};
  if (s.model == Model::beam) {
    const double fall = (1 - d_m / (2 * s.max_range_m)) * s.reliability;
    if (d_m < s.min_range_m || d_m > s.max_range_m || std::fabs(theta_rad) > s.beam_step_rad / 2) return {};
    const double e = d_m < range_m - s.beam.empty_margin_m ? s.beam.empty * fall * s.reliability_if_occupied : 0;
    const double o =
        std::fabs(d_m - range_m) <= s.beam.occupied_half_width_m ? s.beam.occupied * fall * s.reliability_if_empty : 0;
    return {e, o, 1 - e - o, 0};
  }
  const double alpha = s.aperture_rad / 2;
  kernels::ConeType type(cone_spec(s, cell_m));
  const kernels::ConeLimits at = kernels::cone_limits_m(type.spec, range_m);
  // A hair of tolerance: a user's "on the arc" is a decimal number.
  if (std::fabs(theta_rad) > alpha + 1e-12 || d_m > at.outer + 1e-9 || d_m < s.min_range_m - 1e-9) return {};
  kernels::ConeReading q = kernels::compile_cone(type, {0, 0, 0}, range_m);
  type.lattice = 0;
  kernels::compile_model(type, range_m, q);
  const double d = d_m / cell_m;
  const auto from_ring = [&](double ring_m) {
    const double v = (d_m - ring_m) * (d_m + ring_m) / (cell_m * cell_m);
    return static_cast<float>(std::fabs(v) < 1e-5 ? 0 : v);
  };
  // By the edges as they are on their grid: the model's fits are scaled to those.
  const double dx = d * std::cos(theta_rad), dy = d * std::sin(theta_rad);
  const auto nl = static_cast<float>(dx * q.ly - dy * q.lx), nr = static_cast<float>(dy * q.rx - dx * q.ry);
  const kernels::PointMass m =
      kernels::measure_point(type.spec.model, q, std::fmax(nl, 0.0f), std::fmax(nr, 0.0f), static_cast<float>(d * d),
                             from_ring(at.edge), std::fmin(from_ring(at.outer), 0.0f));
  if (model_row(s.model).says == Says::memberships) {
    const double e = std::fmin(m.x, 1.0f), o = std::fmin(m.y, 1.0f);  // as the rule takes them
    return {e, o, (1 - e) * (1 - o), e * o};
  }
  const double sum = static_cast<double>(m.x) + m.y + m.v + m.z;
  return {m.x / sum, m.y / sum, m.v / sum, m.z / sum};
}

}  // namespace evigrid
