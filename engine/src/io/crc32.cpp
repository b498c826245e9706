// SPDX-License-Identifier: Apache-2.0
// CRC-32, eight bytes a step (Kounavis & Berry 2005, "slicing by 8").
#include <array>

#include "io/layout.hpp"

namespace evigrid::io {
namespace {

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr Tables make_tables() {
  Tables t{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    t[0][i] = c;
  }
  for (std::size_t k = 1; k < 8; ++k) {
    for (std::size_t i = 0; i < 256; ++i) t[k][i] = t[0][t[k - 1][i] & 0xFF] ^ (t[k - 1][i] >> 8);
  }
  return t;
}
constexpr Tables kTables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::byte> data) noexcept {
  std::uint32_t c = 0xFFFFFFFFu;
  std::size_t i = 0;
  for (; i + 8 <= data.size(); i += 8) {
    const auto low = c ^ number_at<std::uint32_t>(data, i);
    const auto high = number_at<std::uint32_t>(data, i + 4);
    c = kTables[7][low & 0xFF] ^ kTables[6][low >> 8 & 0xFF] ^ kTables[5][low >> 16 & 0xFF] ^ kTables[4][low >> 24] ^
        kTables[3][high & 0xFF] ^ kTables[2][high >> 8 & 0xFF] ^ kTables[1][high >> 16 & 0xFF] ^ kTables[0][high >> 24];
  }
  for (; i < data.size(); ++i) c = kTables[0][(c ^ std::to_integer<std::uint32_t>(data[i])) & 0xFF] ^ (c >> 8);
  return ~c;
}

}  // namespace evigrid::io
