// SPDX-License-Identifier: Apache-2.0
// Counting what a log holds beside its scans. Both tables are bounded: a file of random words must not fill memory.
#include "log/log.hpp"

#include <fmt/format.h>

namespace evigrid::driver {
namespace {

constexpr std::size_t kMaxKeywords = 64;
constexpr std::size_t kMaxWarnings = 10;
constexpr std::size_t kMaxKeywordLength = 24;

/// Reports are JSON and terminals are fragile: only printable ASCII goes into either.
std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, kMaxKeywordLength)) out += (c >= ' ' && c <= '~') ? c : '?';
  return out;
}

}  // namespace

void Log::skip(std::string_view keyword) {
  std::string key = printable(keyword);
  if (skipped.size() >= kMaxKeywords && !skipped.contains(key)) key = "(other)";
  ++skipped[key];
}

void Log::reject(std::string_view file, std::size_t line, std::string_view reason, std::string_view detail) {
  ++malformed[std::string(reason)];
  if (warnings.size() < kMaxWarnings) warnings.push_back(fmt::format("{}:{}: {}: {}", file, line, reason, detail));
}

}  // namespace evigrid::driver
