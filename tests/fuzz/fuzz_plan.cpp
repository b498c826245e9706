// SPDX-License-Identifier: Apache-2.0
// The first byte names the format; what loads is also traced.
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "evigrid/scenes/plan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid;
  constexpr std::array kNames{"f.pgm", "f.png", "f.bmp", "f.map", "f.yaml"};
  constexpr std::size_t kTraced = 1 << 16;  // cells
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  try {
    scenes::ImageScale scale;
    const char* const name = kNames[data[0] % kNames.size()];
    if (name[2] != 'y') scale.resolution_m = 0.05;
    const scenes::FloorPlan plan = scenes::load_plan_bytes(bytes, name, scale);
    if (plan.cells.size() != static_cast<std::size_t>(plan.width * plan.height)) __builtin_trap();
    if (plan.cells.size() <= kTraced) (void)scenes::trace(plan);
  } catch (const scenes::SceneError&) {  // the only way to refuse a file
  }
  return 0;
}
