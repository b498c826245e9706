// SPDX-License-Identifier: Apache-2.0
// The first byte names the format; what loads is also traced. The checksums of a PNG are put right first.
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "evigrid/scenes/plan.hpp"
#include "repair.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid;
  constexpr std::array<std::string_view, 5> kNames{"f.pgm", "f.png", "f.bmp", "f.map", "f.yaml"};
  constexpr std::size_t kTraced = 1 << 16;  // cells
  if (size == 0) return 0;
  const auto given = std::as_bytes(std::span(data, size)).subspan(1);
  std::vector<std::byte> bytes(given.begin(), given.end());
  const std::string_view name = kNames[data[0] % kNames.size()];
  if (name == "f.png") fuzz::repair_png(bytes);
  try {
    scenes::ImageScale scale;
    if (name != "f.yaml") scale.resolution_m = 0.05;
    const scenes::FloorPlan plan =
        scenes::load_plan_bytes(bytes, std::string(EVIGRID_FUZZ_FILES "/").append(name), scale);
    if (plan.cells.size() != static_cast<std::size_t>(plan.width * plan.height)) __builtin_trap();
    if (plan.cells.size() <= kTraced) (void)scenes::trace(plan);
  } catch (const scenes::SceneError&) {  // the only way to refuse a file
  }
  return 0;
}
