// SPDX-License-Identifier: Apache-2.0
// One entry for each format that can be read; each reader's own file defines its entry. To add a format: write its
// file, name its entry here and in formats.cpp.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/log.hpp"
#include "log/source.hpp"

namespace evigrid::driver {

/// A line near the start of a file, split both ways, for a format to recognise. Never empty, never a comment.
struct FirstLine {
  std::string_view text;
  std::vector<std::string_view> blanks, commas;
};

struct Format {
  const char* name;
  const char* what;                                   ///< for help and messages
  bool (*looks)(const FirstLine&);                    ///< is that a line of this format?
  bool (*owns)(const std::filesystem::path& folder);  ///< null: a folder is never one log of this format
  /// The files of a log from whatever the user named; null: exactly the named ones.
  std::vector<Source> (*gather)(std::span<const Source> named);
  std::size_t most_files;
  void (*read)(std::span<const Source>, Log&);  ///< gets at least one source and at most most_files
};

extern const Format kCarmen, kRing8, kWean, kLego, kBigWheelBot, kRoomba12, kUci24, kEnmt482, kCast;

std::span<const Format* const> all_formats();

}  // namespace evigrid::driver
