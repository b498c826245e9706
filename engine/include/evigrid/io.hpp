// SPDX-License-Identifier: Apache-2.0
// A map in a file, bit for bit: parameters, sensors, last stamp, window, protected areas and every plane of every tile.
// A loaded map goes on fusing as if it had never been saved. Little-endian, versioned, checksummed block by block;
// docs/map_file.md has the layout. Damage is always an error, never another map.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/map.hpp"
#include "evigrid/view.hpp"

namespace EVIGRID_API evigrid {

/// "FILE: what is wrong": not a map, truncated, checksum of tile n, a newer version, cannot be written …
class MapFileError : public std::runtime_error {
 public:
  MapFileError(std::string_view file, std::string_view reason)
      : std::runtime_error(std::string(file) + ": " + std::string(reason)) {}
};

inline constexpr std::uint32_t kMapFileVersion = 2;  ///< older ones stay readable

/// What a file says of itself without its cells.
struct MapFileInfo {
  std::uint32_t format_version = 0;
  int maths_version = 0;  ///< of the program that fused the map
  MapParams params;
  std::vector<Sensor> sensors;
  std::vector<std::string> planes;  ///< of the state, "e", "o", "u" for most rules, then "conflict" … where kept
  std::optional<std::int64_t> last_stamp_ns;
  std::optional<CellRect> window;         ///< Map::set_window, widened to whole tiles
  std::vector<CellRect> protected_areas;  ///< Map::protect
  std::uint64_t hash = 0;                 ///< Map::hash() when it was saved
  std::uint64_t tiles = 0, file_bytes = 0, memory_bytes = 0;
};

/// What belongs to this machine and not to the map.
struct LoadOptions {
  std::shared_ptr<Executor> executor{};  ///< as in Map's constructor
  std::optional<Kernel> kernel{};        ///< else the saved one, or the widest where that cannot run here
  /// Checked before anything is allocated, and then the map's cap; else the saved one. Give it for files of strangers.
  std::optional<std::size_t> memory_cap_bytes{};
  /// As Map::page_to: a map larger than the cap is then loaded nevertheless, most of it into the page file.
  std::optional<std::filesystem::path> page_directory{};
  /// Only these cells: the map has no others, as if all around them had been cleared. The tiles that meet the region
  /// are read and proved by their checksums, the rest of the file is not; the hash of the whole cannot be. The cap is
  /// held against those tiles alone.
  std::optional<CellRect> region{};
  std::uint64_t* bytes_read = nullptr;  ///< where given, gets how many bytes of the file were read
};

/// Written beside, synchronised with the disk, renamed: `path` never holds half a map. Runs on the map's executor.
/// Throws MapFileError when the file cannot be written, or sensors and protected areas are too many for its header
/// (64 MiB).
void save(const Map&, const std::filesystem::path& path);
/// The same bytes into a stream. Throws MapFileError when the stream fails.
void save(const Map&, std::ostream&);

/// A view is saved while its map goes on fusing: the bytes are those of the map at the view's version. On the calling
/// thread, or on an executor that is not the busy map's own.
void save(const MapView&, const std::filesystem::path& path, Executor* = nullptr);
void save(const MapView&, std::ostream&, Executor* = nullptr);

/// Throws MapFileError for what is damaged, not a map, of a newer version, or larger than the cap, for parameters that
/// no map accepts and a kernel that cannot run here. With a page directory std::system_error, as Map::page_to, and
/// std::length_error for a cap below one tile.
[[nodiscard]] Map load(const std::filesystem::path& path, const LoadOptions& = {});
/// @param name what errors call the bytes.
[[nodiscard]] Map load(std::span<const std::byte>, const LoadOptions& = {}, std::string_view name = "map");

/// Head, header, directory's place and sizes, without the cells. Throws MapFileError.
[[nodiscard]] MapFileInfo inspect(const std::filesystem::path& path);
[[nodiscard]] MapFileInfo inspect(std::span<const std::byte>, std::string_view name = "map");

}  // namespace evigrid
