// SPDX-License-Identifier: Apache-2.0
// The scalar table: any x86-64. Also the single points, from the same text.
#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
// After the target.
#include "kernels/row/fill_pcr.hpp"
#include "kernels/row/fill_pcr14.hpp"
#include "kernels/row/table.hpp"

namespace evigrid::kernels {

const KernelTable& scalar_table() noexcept {
  static const KernelTable table = scalar::make_table("scalar", 1);
  return table;
}

PointMass measure_point(int cone_model, const ConeReading& q, float nl, float nr, float d2, float edge) {
  const scalar::Polar<float> p{nl, nr, d2, edge, edge};
  const auto s = cone_model == 0
                     ? scalar::widen(scalar::discount(scalar::ModelHughes1992::measure(q, p), q.reliability, q.doubt))
                     : scalar::discount(scalar::ModelLi2014::measure(q, p), q.reliability, q.doubt);
  return {s.x, s.y, s.v, s.z, s.s};
}

}  // namespace evigrid::kernels
