// SPDX-License-Identifier: Apache-2.0
#include "repair.hpp"

#include <algorithm>
#include <array>

namespace evigrid::fuzz {
namespace {

std::uint32_t crc32(std::span<const std::byte> bytes) {
  std::uint32_t c = 0xffffffffu;
  for (const std::byte b : bytes) {
    c ^= std::to_integer<std::uint32_t>(b);
    for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xedb88320u ^ c >> 1 : c >> 1;
  }
  return ~c;
}

std::uint64_t little(std::span<const std::byte> in, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(in[at + i]);
  return value;
}

void put_little(std::span<std::byte> out, std::size_t at, std::size_t count, std::uint64_t value) {
  for (std::size_t i = 0; i < count; ++i) out[at + i] = static_cast<std::byte>(value >> (8 * i) & 0xff);
}

}  // namespace

void repair_png(std::span<std::byte> bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // of a chunk: length, type and checksum
  for (std::size_t at = kSignature; at < bytes.size() && bytes.size() - at >= kFrame;) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(bytes[at + i]);
    if (length > bytes.size() - at - kFrame) return;
    const std::uint32_t crc = crc32(bytes.subspan(at + 4, length + 4));
    for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<std::byte>(crc >> (24 - 8 * i) & 0xff);
    at += kFrame + length;
  }
}

void repair_map_file(std::span<std::byte> bytes) {
  constexpr std::size_t kHead = 24, kEntry = 32, kTail = 40;
  if (bytes.size() < kHead + kTail) return;
  const std::size_t tail = bytes.size() - kTail;
  const std::size_t text = std::min<std::size_t>(little(bytes, 12, 4), tail - kHead);
  const std::size_t tiles = std::min<std::size_t>(little(bytes, tail + 8, 8), (tail - kHead - text) / kEntry);
  const std::size_t directory = tail - tiles * kEntry;
  std::size_t next = kHead + text;
  for (std::size_t i = 0; i < tiles; ++i) {
    const std::size_t entry = directory + i * kEntry, left = directory - next;
    const std::size_t length = i + 1 == tiles ? left : std::min<std::size_t>(little(bytes, entry + 24, 4), left);
    put_little(bytes, entry + 16, 8, next);
    put_little(bytes, entry + 24, 4, length);
    put_little(bytes, entry + 28, 4, crc32(bytes.subspan(next, length)));
    next += length;
  }
  put_little(bytes, 12, 4, text);
  put_little(bytes, 16, 4, crc32(bytes.subspan(kHead, text)));
  put_little(bytes, 20, 4, crc32(bytes.first(20)));
  put_little(bytes, tail, 8, directory);
  put_little(bytes, tail + 8, 8, tiles);
  put_little(bytes, tail + 16, 8, bytes.size());
  put_little(bytes, tail + 24, 4, crc32(bytes.subspan(directory, tail - directory)));
  put_little(bytes, tail + 28, 4, crc32(bytes.subspan(tail, 28)));
}

void repair_journal(std::span<std::byte> bytes) {
  constexpr std::size_t kHead = 24, kRecord = 20;
  if (bytes.size() < kHead) return;
  const std::size_t text = std::min<std::size_t>(little(bytes, 12, 4), bytes.size() - kHead);
  put_little(bytes, 12, 4, text);
  put_little(bytes, 16, 4, crc32(bytes.subspan(kHead, text)));
  put_little(bytes, 20, 4, crc32(bytes.first(20)));
  for (std::size_t at = kHead + text; bytes.size() - at >= kRecord;) {
    const std::size_t payload = std::min<std::size_t>(little(bytes, at, 4), bytes.size() - at - kRecord);
    put_little(bytes, at, 4, payload);
    std::array<std::byte, kRecord> covered{};
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), 16, covered.begin());
    put_little(covered, 16, 4, crc32(bytes.subspan(at + kRecord, payload)));
    put_little(bytes, at + 16, 4, crc32(covered));
    at += kRecord + payload;
  }
}

void repair_scan_log(std::span<std::byte> bytes) {
  constexpr std::size_t kHead = 16, kFixed = 48, kTail = 16;
  if (bytes.size() < kHead + kTail) return;
  const std::size_t room = bytes.size() - kHead - kTail, map = std::min<std::size_t>(little(bytes, 12, 4), room);
  const std::size_t record = kFixed + 4 * static_cast<std::size_t>(little(bytes, 8, 4)), end = bytes.size() - kTail;
  put_little(bytes, 12, 4, map);
  put_little(bytes, end, 8, (room - map) / record);
  put_little(bytes, end + 8, 4, crc32(bytes.first(end + 8)));
  put_little(bytes, end + 12, 4, 0);
}

}  // namespace evigrid::fuzz
