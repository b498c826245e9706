// SPDX-License-Identifier: Apache-2.0
// Which format a path holds. A folder or a pair of files is a ring; a single file tells by its first record: CARMEN
// starts with a word, the ring with a number.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "error.hpp"
#include "log/line_reader.hpp"
#include "log/readers.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;
constexpr const char* kPoses = "poses.txt";
constexpr const char* kMeasurements = "measurement.txt";

/// Fields of the first record when it starts with a number, else 0.
std::size_t numeric_columns(const std::string& path) {
  LineReader lines(path);
  std::string_view line;
  std::vector<std::string_view> tokens;
  double ignored = 0;
  while (lines.next(line)) {
    split(line, tokens);
    if (tokens.empty() || tokens[0].front() == '#') continue;
    return parse_number(tokens[0], ignored) ? tokens.size() : 0;
  }
  return 0;
}

std::string detect(const std::vector<std::string>& paths) {
  if (fs::is_directory(paths.front())) return "ring8";
  const std::size_t columns = numeric_columns(paths.front());
  return columns == 4 || columns == 9 ? "ring8" : "carmen";
}

/// The two files of a ring from whatever the user named: the folder, one file, or both in any order.
std::pair<std::string, std::string> ring_files(const std::vector<std::string>& paths) {
  if (paths.size() > 2) throw InputError("format ring8 takes a folder, one file or two files");
  if (paths.size() == 2) {
    const bool swapped = fs::path(paths[0]).filename() == kMeasurements || numeric_columns(paths[0]) == 9;
    return swapped ? std::pair{paths[1], paths[0]} : std::pair{paths[0], paths[1]};
  }
  const fs::path given = paths.front();
  const fs::path folder = fs::is_directory(given) ? given : given.parent_path();
  if (fs::is_directory(given)) return {(folder / kPoses).string(), (folder / kMeasurements).string()};
  if (numeric_columns(given.string()) == 4) return {given.string(), (folder / kMeasurements).string()};
  return {(folder / kPoses).string(), given.string()};
}

}  // namespace

const std::vector<std::string>& log_formats() {
  static const std::vector<std::string> names{"auto", "carmen", "ring8"};
  return names;
}

Log read_log(const std::vector<std::string>& paths, const std::string& format) {
  if (paths.empty()) throw InputError("no log file named");
  Log log;
  log.format = format == "auto" ? detect(paths) : format;
  if (log.format == "ring8") {
    const auto [poses, measurements] = ring_files(paths);
    read_ring8(poses, measurements, log);
  } else if (log.format == "carmen") {
    for (const std::string& path : paths) read_carmen(path, log);
    find_no_return(log);
  } else {
    throw InputError(fmt::format("--format: '{}' is unknown; known: {}", format, fmt::join(log_formats(), ", ")));
  }
  if (log.scans.empty()) {
    std::string why;
    if (!log.warnings.empty()) why = "; first: " + log.warnings.front();
    throw InputError(fmt::format(
        "no usable record in {}: read as {}, {} kinds of other records, {} malformed{}", fmt::join(paths, ", "),
        log.format, log.skipped.size(),
        [&] {
          std::uint64_t n = 0;
          for (const auto& [reason, times] : log.malformed) n += times;
          return n;
        }(),
        why));
  }
  return log;
}

}  // namespace evigrid::driver
