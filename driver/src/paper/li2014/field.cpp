// SPDX-License-Identifier: Apache-2.0
#include "paper/li2014/field.hpp"

#include "evigrid/scenes/truth.hpp"

namespace evigrid::driver {

FieldRect field_of(const scenes::Scene& scene, int margin) {
  const double c = scene.map.cell_m;
  const scenes::Extent box = scenes::extent(scene.world);
  FieldRect out{{}, c};
  out.rect.x = std::llround(std::floor(box.low.x_m / c)) - margin;
  out.rect.y = std::llround(std::floor(box.low.y_m / c)) - margin;
  out.rect.width = std::llround(std::ceil(box.high.x_m / c)) + margin - out.rect.x;
  out.rect.height = std::llround(std::ceil(box.high.y_m / c)) + margin - out.rect.y;
  return out;
}

std::vector<std::uint8_t> occupied_cells(const Map& map, const FieldRect& field) {
  std::vector<float> decision(field.cells());
  map.render(Layer::decision, field.rect, decision, field.rect.width);
  std::vector<std::uint8_t> out(decision.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = decision[i] == 1;
  return out;
}

}  // namespace evigrid::driver
