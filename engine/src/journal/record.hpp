// SPDX-License-Identifier: Apache-2.0
// The layout of a journal, little-endian whatever the machine:
//   head 24 (as a map file's, another magic) · header text (parameters, sensors) · records
//   record: payload bytes 4, kind 4 (+ 256: a zstd frame), id 8, crc of these 16 bytes and the payload 4 · payload
//   scan: stamp 8, x, y, yaw 8 each, readings 4, of each sensor 4 and number of ranges 4, then all ranges 4 each
//   move: x, y, yaw; remove: nothing
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "evigrid/journal.hpp"

namespace evigrid::journal {

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'E', 'V', 'G', 'J', '\r', '\n', 0x1A};
inline constexpr std::uint32_t kVersion = 1, kCompressed = 256;
inline constexpr std::size_t kRecordHead = 20, kMaxPayload = std::size_t{256} << 20;

std::uint32_t record_crc(std::span<const std::byte> first16, std::span<const std::byte> payload) noexcept;
/// Whether bytes that are at least a record's head begin with a record that ends within them, its checksum right.
bool is_whole(std::span<const std::byte>) noexcept;
/// Whether records of that kind are written.
bool is_kind(std::uint32_t kind) noexcept;
/// The whole record of an event. Throws std::invalid_argument for one that no reader would take.
std::vector<std::byte> encode(JournalEvent::Kind, ScanId, std::span<const std::byte> payload, bool compress);
std::vector<std::byte> scan_payload(const Scan&);
std::vector<std::byte> pose_payload(const Pose2&);
/// Throws std::invalid_argument with what is wrong: a checksum was right, so a program is.
JournalEvent decode(std::uint32_t kind, ScanId, std::span<const std::byte> payload);

}  // namespace evigrid::journal
