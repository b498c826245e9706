// SPDX-License-Identifier: Apache-2.0
// The fixed parts of a map file, little-endian whatever the machine: head, directory, tail. docs/map_file.md.
//   head 24: magic 8, version 4, header bytes 4, crc of header 4, crc of these 20 bytes 4
//   header text · one block a tile, without gaps · directory, 32 a tile · tail 40
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace evigrid::io {

// Not text, and damaged by any change of line ends or of the eighth bit (the idea is PNG's).
inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'E', 'V', 'G', 'R', '\r', '\n', 0x1A};
inline constexpr std::array<std::uint8_t, 8> kEndMagic{'E', 'V', 'G', 'R', '-', 'E', 'N', 'D'};
inline constexpr std::size_t kHeadBytes = 24, kEntryBytes = 32, kTailBytes = 40;
inline constexpr std::size_t kMaxHeaderBytes = std::size_t{64} << 20;
inline constexpr std::int64_t kMaxTile = std::int64_t{1} << 56;  // its cells still have 64-bit indices

/// CRC-32 of ISO 3309 (polynomial 0xEDB88320), as in gzip and PNG.
std::uint32_t crc32(std::span<const std::byte>) noexcept;

struct Entry {  // of the directory: one tile
  std::int64_t x = 0, y = 0;
  std::uint64_t offset = 0;
  std::uint32_t bytes = 0, crc = 0;  // of the block as it lies in the file
  std::size_t number = 0;            // its place in the directory, for messages
};

struct Tail {
  std::uint64_t directory_offset = 0, tiles = 0, file_bytes = 0;
  std::uint32_t directory_crc = 0;
};

class Bytes {  // appends
 public:
  template <class T>
  void put(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
      out_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF));
  }
  void put_raw(std::span<const std::uint8_t> raw) {
    for (const std::uint8_t b : raw) out_.push_back(std::byte{b});
  }
  [[nodiscard]] std::span<const std::byte> get() const noexcept { return out_; }

 private:
  std::vector<std::byte> out_;
};

/// The number at `at`; the caller has checked that it lies inside.
template <class T>
T number_at(std::span<const std::byte> in, std::size_t at) noexcept {
  std::uint64_t v = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) v |= std::to_integer<std::uint64_t>(in[at + i]) << (8 * i);
  return static_cast<T>(v);
}

}  // namespace evigrid::io
