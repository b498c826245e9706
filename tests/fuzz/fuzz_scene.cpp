// SPDX-License-Identifier: Apache-2.0
// The limits are low: the work that a scene may ask for grows with them, and what is looked for are faults, not large
// buildings. The files that a scene names are looked for in tests/fuzz/files.
#include <cstdint>

#include "evigrid/scenes/scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid::scenes;
  constexpr SceneLimits kLow{.most_tour_cells = 1 << 16, .most_pieces = 2000};
  try {
    (void)parse_scene({reinterpret_cast<const char*>(data), size}, EVIGRID_FUZZ_FILES "/fuzz.toml", {}, kLow);
  } catch (const SceneError&) {  // the only way to refuse
  }
  return 0;
}
