// SPDX-License-Identifier: Apache-2.0
// The scalar table: any x86-64. Also the single points, from the same text.
#define EVIGRID_LAMBDA
#define EVIGRID_BATCH_NAMESPACE scalar
#include "kernels/cell/lane_scalar.hpp"
// After the target.
#include "kernels/row/fill_pcr.hpp"
#include "kernels/row/fill_pcr14.hpp"
#include "kernels/row/fill_states.hpp"
#include "kernels/row/table.hpp"

namespace evigrid::kernels {

const KernelTable& scalar_table() noexcept {
  static const KernelTable table = scalar::make_table("scalar", 1);
  return table;
}

namespace {
template <class Model>
PointMass point(const ConeReading& q, const scalar::Polar<float>& p) {
  const auto m = scalar::widen(scalar::discounted(q, Model::measure(q, p)));
  return {m.part[0], m.part[1], m.part[2], m.part[3], m.part[4]};
}
constexpr PointMass (*kPoint[kConeModels])(const ConeReading&, const scalar::Polar<float>&) = {
    point<scalar::ModelHughes1992>, point<scalar::ModelLi2014>,      point<scalar::ModelOriolo1997>,
    point<scalar::ModelLi2006>,     point<scalar::ModelProbability>, point<scalar::ModelFuzzy>,
    point<scalar::ModelMoravec1985>};
}  // namespace

PointMass measure_point(int cone_model, const ConeReading& q, float nl, float nr, float d2, float edge, float outer) {
  return kPoint[cone_model](q, {nl, nr, d2, edge, edge, outer});
}

}  // namespace evigrid::kernels
