// SPDX-License-Identifier: Apache-2.0
// A map in other programs' formats. docs/formats.md says what each holds.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/map.hpp"
#include "export/planes.hpp"
#include "out/layers.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {

enum class ExportFormat : std::uint8_t { csv, npy, map_server, octomap, bag };

struct ExportOptions {
  std::vector<std::string> planes;  ///< csv, npy; empty: standard_planes()
  bool metres = false;              ///< csv: centres of cells in metres, else indices
  std::string mode = "trinary";     ///< map_server
  double occupied = kOccupiedThreshold, free = kFreeThreshold, max_unknown = 0.9;  ///< as Costmap's
  double z_low_m = 0, z_high_m = 0;  ///< octomap: the slab; equal: one layer of voxels
  std::string frame = "map", topic = "/map";
  int max_image_mb = 2048;
};

/// Of the map and its file what the planes do not say.
struct Exported {
  const Map& map;
  CellRect rect;  ///< dense formats: all of it
  std::int64_t stamp_ns = 0;
  std::string source, hash;
};

/// As --format has it.
std::string_view name(ExportFormat format);
/// From a --format name. Throws InputError listing the names.
ExportFormat parse_export_format(const std::string& name);
/// By the extension of -o: .csv, .npy (a folder has none), .yaml/.yml/.pgm, .bt, .bag. Throws InputError.
ExportFormat export_format_of(const std::filesystem::path& out);
/// Throws InputError when that format's library was not there when evigrid was built, naming the package.
void require_built(ExportFormat format);
/// Throws InputError for thresholds, names and heights that are none.
void check_export(const ExportOptions& options);

/// Writes `out` (npy: a folder), all files of it at once when all of them are complete; csv: "-" is standard output.
void export_map(const Exported& what, ExportFormat format, const ExportOptions& options, const std::string& out);

}  // namespace evigrid::driver
