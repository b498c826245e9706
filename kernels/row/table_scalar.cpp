// SPDX-License-Identifier: Apache-2.0
// The scalar table: any x86-64. Also the single points and the double-precision batch, from the same text.
#define EVIGRID_LAMBDA
#include "kernels/cell/lane_scalar.hpp"
#include "kernels/row/table.hpp"

namespace evigrid::kernels {

const KernelTable& scalar_table() noexcept {
  static const KernelTable table = scalar::make_table("scalar", 1);
  return table;
}

PointMass measure_point(int cone_model, const ConeReading& q, float nl, float nr, float d2, float edge) {
  const scalar::Polar<float> p{nl, nr, d2, edge};
  const auto s = cone_model == 0 ? scalar::widen(scalar::discount(scalar::ModelHughes1992::measure(q, p), q.reliability, q.doubt))
                                 : scalar::discount(scalar::ModelLi2014::measure(q, p), q.reliability, q.doubt);
  return {s.x, s.y, s.v, s.z, s.s};
}

namespace {
template <class Rule>
std::uint64_t dense_double_rule(const double* const a[3], const double* const b[3], double* const c[3], double* k,
                                std::size_t begin, std::size_t end) {
  std::uint64_t totals = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const auto r = scalar::combine_exact<Rule>(a[0][i], a[1][i], a[2][i], b[0][i], b[1][i], b[2][i]);
    c[0][i] = r.cell.a;
    c[1][i] = r.cell.b;
    c[2][i] = r.cell.u;
    if (k != nullptr) k[i] = r.k;
    if constexpr (Rule::kTotalPossible) totals += r.total ? 1 : 0;
  }
  return totals;
}
}  // namespace

std::uint64_t dense_double(int rule, const double* const a[3], const double* const b[3], double* const c[3], double* k,
                           std::size_t begin, std::size_t end) {
  switch (rule) {
    case 0: return dense_double_rule<scalar::Dempster>(a, b, c, k, begin, end);
    case 1: return dense_double_rule<scalar::Pcr2>(a, b, c, k, begin, end);
    case 2: return dense_double_rule<scalar::Pcr5>(a, b, c, k, begin, end);
    default: return dense_double_rule<scalar::GermPcr2>(a, b, c, k, begin, end);
  }
}

}  // namespace evigrid::kernels
