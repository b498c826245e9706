// SPDX-License-Identifier: Apache-2.0
#include "log/named_sources.hpp"

#include <filesystem>

#include "log/line_reader.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;

bool can_be_read_once(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

std::string text_of(const std::string& path) {
  LineReader lines(path);
  std::string text;
  for (std::string_view line; lines.next(line);) text.append(line) += '\n';
  return text;
}

}  // namespace

NamedSources::NamedSources(std::span<const std::string> paths) {
  for (const std::string& path : paths) {
    sources_.push_back({path});
    if (can_be_read_once(path)) sources_.back().bytes = texts_.emplace_back(text_of(path));
  }
}

}  // namespace evigrid::driver
