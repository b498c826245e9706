// SPDX-License-Identifier: Apache-2.0
// The formats that `map` reads, and telling them apart.
#pragma once
#include <string>
#include <vector>

#include "log/log.hpp"

namespace evigrid::driver {

/// Names of --format, "auto" first.
const std::vector<std::string>& log_formats();

/// Reads one or more paths of a format ("auto" looks). Throws InputError naming the file for anything unreadable, and
/// when no record of it can be used.
Log read_log(const std::vector<std::string>& paths, const std::string& format);

/// CARMEN text logs, appended to `log` in line order: carmen.cpp.
void read_carmen(const std::string& path, Log& log);

/// Sets each fan's no_return_m from the log's own largest ranges and turns absurd ranges into NaN: carmen.cpp.
void find_no_return(Log& log);

/// The ring of eight sonars: one file of poses, one of measurements, matched by time stamp: ring8.cpp.
void read_ring8(const std::string& poses_path, const std::string& measurements_path, Log& log);

}  // namespace evigrid::driver
