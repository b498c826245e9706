// SPDX-License-Identifier: Apache-2.0
// Checksums and sizes put right after damage: without this a fuzzer never comes past them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace evigrid::fuzz {

/// The checksums of a PNG's chunks, as far as chunks can be followed.
void repair_png(std::span<std::byte> bytes);

/// Checksums, offsets and the file's size in a saved map (docs/map_file.md), as far as its parts can be followed.
void repair_map_file(std::span<std::byte> bytes);

/// Checksums of a journal's head and records, as far as records can be followed (docs/life_of_a_map.md).
void repair_journal(std::span<std::byte> bytes);

/// Count of scans and checksum of a fleet's scan log (docs/cycle.md).
void repair_scan_log(std::span<std::byte> bytes);

}  // namespace evigrid::fuzz
