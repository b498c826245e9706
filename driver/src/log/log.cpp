// SPDX-License-Identifier: Apache-2.0
// Counting what a log holds beside its scans. Both tables are bounded: a file of random words must not fill memory.
#include "log/log.hpp"

#include <fmt/format.h>

namespace evigrid::driver {
namespace {

constexpr std::size_t kMaxKeywords = 64;
constexpr std::size_t kMaxWarnings = 10;
constexpr std::size_t kMaxKeywordLength = 24;

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text) out += (c >= ' ' && c <= '~') ? c : '?';
  return out;
}

std::string_view name(Poses poses) {
  switch (poses) {
    case Poses::recorded:
      return "recorded";
    case Poses::dead_reckoned:
      return "dead reckoning";
    case Poses::none:
      return "none: the robot stands at the origin";
    case Poses::one_dimension:
      return "along a line";
  }
  return "";
}

std::uint64_t Log::malformed_total() const {
  std::uint64_t n = 0;
  for (const auto& [reason, times] : malformed) n += times;
  return n;
}

void Log::skip(std::string_view keyword) {
  std::string key = printable(keyword.substr(0, kMaxKeywordLength));
  if (skipped.size() >= kMaxKeywords && !skipped.contains(key)) key = "(other)";
  ++skipped[key];
}

void Log::reject(std::string_view file, std::size_t line, std::string_view reason, std::string_view detail) {
  ++malformed[std::string(reason)];
  if (warnings.size() < kMaxWarnings) warnings.push_back(fmt::format("{}:{}: {}: {}", file, line, reason, detail));
}

}  // namespace evigrid::driver
