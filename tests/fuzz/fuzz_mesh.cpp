// SPDX-License-Identifier: Apache-2.0
// The first byte names the format; what loads is also sliced.
#include <cstdint>
#include <span>

#include "evigrid/scenes/mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid;
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  try {
    const scenes::Mesh mesh = scenes::load_mesh_bytes(bytes, data[0] % 2 == 0 ? ".ply" : ".obj", "fuzz");
    for (const auto& face : mesh.faces) {
      for (const std::uint32_t v : face) {
        if (v >= mesh.vertices.size()) __builtin_trap();
      }
    }
    for (const double height_m : {0.3, 0.0, 1.0}) (void)scenes::slice(mesh, {.height_m = height_m});
  } catch (const scenes::SceneError&) {  // the only way to refuse a file
  }
  return 0;
}
