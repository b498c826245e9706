// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "evigrid/scenes/scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)evigrid::scenes::parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const evigrid::scenes::SceneError&) {  // the only way to refuse
  }
  return 0;
}
