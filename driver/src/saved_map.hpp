// SPDX-License-Identifier: Apache-2.0
// A saved map as commands name it: the file, or the folder that `map` and `run` wrote.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "evigrid/io.hpp"

namespace evigrid::driver {

inline constexpr const char* kMapFile = "map.evigrid";

struct SavedMap {
  std::string path;  ///< the file itself
  MapFileInfo info;
  Map map;                       ///< read whole and proved against every checksum and the saved hash, or a part of it
  std::uint64_t bytes_read = 0;  ///< of the file
};

/// Throws InputError naming the file and what is wrong with it. @param region_m x0, y0, x1, y1: only this part; empty:
/// the whole map.
SavedMap open_saved_map(const std::string& path, std::shared_ptr<Executor> executor = nullptr,
                        const std::vector<double>& region_m = {});

/// "pcr5, cell 0.05 m": the line that titles a picture of it.
std::string describe_map(const SavedMap&);

}  // namespace evigrid::driver
