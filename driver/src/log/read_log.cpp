// SPDX-License-Identifier: Apache-2.0
// Which format a log holds, and its reading. A folder tells by the names of its files, a file by its first lines: the
// first line that any format knows decides, so that one damaged record does not.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "bag/bag.hpp"
#include "error.hpp"
#include "log/formats.hpp"
#include "log/line_reader.hpp"
#include "log/named_sources.hpp"
#include "log/readers.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;
constexpr int kLinesTried = 200;
constexpr std::size_t kFieldsTried = 512, kShown = 60;

std::string known_names() {
  std::string out;
  for (const Format* format : all_formats()) out += (out.empty() ? "" : ", ") + std::string(format->name);
  return out;
}

const Format& format_of_lines(const Source& source) {
  LineReader lines(source);
  FirstLine line;
  std::string first;
  for (int tried = 0; tried < kLinesTried && lines.next(line.text);) {
    split(line.text, line.blanks, kFieldsTried);
    if (line.blanks.empty() || line.blanks[0].front() == '#') continue;
    split_commas(line.text, line.commas, kFieldsTried);
    if (tried++ == 0) first = printable(line.text.substr(0, kShown));
    for (const Format* format : all_formats()) {
      if (format->looks(line)) return *format;
    }
  }
  if (first.empty()) {
    throw InputError(fmt::format("no usable record in {}: it is empty or holds comments alone", source.name));
  }
  throw InputError(fmt::format("{}: looks like none of: {}; first line is '{}'; --format can name one", source.name,
                               known_names(), first));
}

const Format& format_of_folder(const fs::path& folder) {
  for (const Format* format : all_formats()) {
    if (format->owns != nullptr && format->owns(folder)) return *format;
  }
  throw InputError(
      fmt::format("{}: is a folder without a log that is one: neither poses.txt and measurement.txt "
                  "(ring8) nor *scan.txt and *motors.txt (lego)",
                  folder.string()));
}

// No table of lines: neither looked for among them, nor read from memory.
constexpr const char* kBag = "bag";

bool looks_like_bag(const std::string& path) {
  constexpr std::string_view kMagic = "#ROSBAG V";
  char first[kMagic.size()]{};
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  std::ifstream(path, std::ios::binary).read(first, sizeof first);
  return std::string_view(first, sizeof first) == kMagic;
}

const Format& format_named(const std::string& name) {
  for (const Format* format : all_formats()) {
    if (name == format->name) return *format;
  }
  throw InputError(fmt::format("--format: '{}' is unknown; known: {}", name, fmt::join(log_formats(), ", ")));
}

Log usable(Log log, const std::string& names) {
  if (!log.scans.empty()) return log;
  throw InputError(fmt::format("no usable record in {}: read as {}, {} kinds of other records, {} malformed{}", names,
                               log.format, log.skipped.size(), log.malformed_total(),
                               log.warnings.empty() ? "" : "; first: " + log.warnings.front()));
}

Log read_one_bag(const std::vector<std::string>& paths, const BagOptions& options) {
  if (paths.size() > 1) throw InputError(fmt::format("format {} takes one file, {} are named", kBag, paths.size()));
  std::error_code ignored;
  if (!fs::exists(paths.front(), ignored)) throw InputError(paths.front() + ": there is no such file");
  if (!fs::is_regular_file(paths.front(), ignored))
    throw InputError(paths.front() + ": is no file; a bag comes neither in a folder nor through a pipe");
  require_bags(paths.front());
  Log log;
  log.format = kBag;
  read_bag(paths.front(), options, log);
  return usable(std::move(log), paths.front());
}

Log read(const Format& format, std::span<const Source> sources) {
  if (sources.size() > format.most_files) {
    throw InputError(fmt::format("format {} takes at most {} file{}, {} are named", format.name, format.most_files,
                                 format.most_files == 1 ? "" : "s", sources.size()));
  }
  Log log;
  log.format = format.name;
  format.read(sources, log);
  std::string names;
  for (const Source& source : sources) names += (names.empty() ? "" : ", ") + source.name;
  return usable(std::move(log), names);
}

const Format& format_of(const NamedSources& named, const std::string& name) {
  const Source& first = named.all().front();
  if (name != "auto") return format_named(name);
  return fs::is_directory(first.name) ? format_of_folder(first.name) : format_of_lines(first);
}

Log read(const Format& format, const NamedSources& named) {
  if (format.gather != nullptr) return read(format, format.gather(named.all()));
  return read(format, named.all());
}

}  // namespace

const std::vector<std::string>& log_formats() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out{"auto"};
    for (const Format* format : all_formats()) out.emplace_back(format->name);
    out.emplace_back(kBag);
    return out;
  }();
  return names;
}

std::string describe_formats() {
  std::string out;
  for (const Format* format : all_formats()) out += fmt::format("  {:<12}{}\n", format->name, format->what);
  return out +
         fmt::format("  {:<12}{}\n", kBag, "ROS bag: sensor_msgs/LaserScan and Range, with tf or nav_msgs/Odometry");
}

Log read_log(const std::vector<std::string>& paths, const std::string& name, const BagOptions& bag) {
  if (paths.empty()) throw InputError("no log file named");
  if (name == kBag || (name == "auto" && looks_like_bag(paths.front()))) return read_one_bag(paths, bag);
  const NamedSources named(paths);
  const Format& format = format_of(named, name);
  refuse_bag_options(bag);
  return read(format, named);
}

Log read_text_log(const NamedSources& named, const std::string& name) { return read(format_of(named, name), named); }

Log read_log_bytes(const std::string& name, std::span<const std::string_view> files) {
  if (files.empty()) throw InputError("no log file named");
  std::vector<Source> sources;
  for (const std::string_view bytes : files) {
    sources.push_back({fmt::format("(bytes {})", sources.size() + 1), bytes});
  }
  if (name == kBag) throw InputError("format bag is read from files alone");
  return read(name == "auto" ? format_of_lines(sources.front()) : format_named(name), sources);
}

}  // namespace evigrid::driver
