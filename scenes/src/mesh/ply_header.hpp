// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file (Turk, "The PLY polygon file format", 1994): elements, their properties and their types.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace evigrid::scenes {

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t size_of(PlyType type);
[[nodiscard]] inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type;  ///< of the value, or of each item of the list
  bool is_list = false;
  PlyType count_type{};  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::uint64_t line = 0;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  ///< where the data begin
};

/// Throws SceneError.
[[nodiscard]] PlyHeader read_ply_header(std::string_view text, std::string_view name);

}  // namespace evigrid::scenes
