// SPDX-License-Identifier: Apache-2.0
// Text to TOML, with a bound on how deep its tables lie. toml++ bounds values within values, but not the parts of a
// dotted key: a key of 100 000 parts makes as many tables within tables, and to destroy them takes the stack of the
// process.
#include <algorithm>

#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostDots = 63;

/// Where a string that begins at `at` ends (just behind it), or the end of the text.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view three = text.substr(at, 3);
  const bool many_lines = three.size() == 3 && three[1] == quote && three[2] == quote;
  for (std::size_t i = at + (many_lines ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (many_lines && text.substr(i, 3) == three) {
      std::size_t end = i + 3;  // up to two more quotes belong to the string
      while (end < std::min(i + 5, text.size()) && text[end] == quote) ++end;
      return end;
    } else if (!many_lines && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    }
  }
  return text.size();
}

/// Dots between two of the characters that end a key: the parts of a key, or at most one of a number.
void refuse_deep_keys(std::string_view text, const std::string& file) {
  std::size_t dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else if (c == '"' || c == '\'') {
      i = behind_string(text, i);
    } else {
      dots = c == '.' ? dots + 1 : std::string_view("\n=,[]{}").find(c) != std::string_view::npos ? 0 : dots;
      if (dots > kMostDots) {
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
        throw SceneError(file + ":" + std::to_string(line) + ": toml: a key has more than " +
                         std::to_string(kMostDots + 1) + " parts");
      }
      ++i;
    }
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  refuse_deep_keys(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    throw SceneError(file + ":" + std::to_string(e.source().begin.line) + ": toml: " + std::string(e.description()));
  }
}

}  // namespace evigrid::scenes
