// SPDX-License-Identifier: Apache-2.0
// Whoever takes damage for a tail cuts good records off, so a tail has nothing behind its record and no whole record in
// it: a length that a flipped bit made large reaches over all those that follow.
#include "journal/tail.hpp"

#include <algorithm>

#include "io/layout.hpp"
#include "journal/record.hpp"

namespace evigrid::journal {
namespace {

constexpr auto kZero = std::byte{0};

/// Whether a record with a right checksum begins anywhere behind the first byte; yes, too, where it would take too long
/// to tell, which what a writer leaves does not.
bool holds_a_record(std::span<const std::byte> left) {
  constexpr std::size_t kPerByte = 16, kAtLeast = std::size_t{1} << 20;
  std::size_t effort = kAtLeast + kPerByte * left.size();
  for (std::size_t at = 1; at + kRecordHead <= left.size(); ++at) {
    const auto record = left.subspan(at);
    if (!is_kind(io::number_at<std::uint32_t>(record, 4))) continue;
    const std::size_t bytes = io::number_at<std::uint32_t>(record, 0);
    if (bytes > record.size() - kRecordHead) continue;
    if (bytes > effort) return true;
    effort -= bytes;
    if (is_whole(record)) return true;
  }
  return false;
}

}  // namespace

bool is_torn_tail(std::span<const std::byte> left) {
  const auto last = std::find_if(left.rbegin(), left.rend(), [](std::byte b) { return b != kZero; });
  const auto written = static_cast<std::size_t>(left.rend() - last);  // behind it a file system left zeros
  if (written == 0 || left.size() < kRecordHead) return true;
  const std::size_t bytes = io::number_at<std::uint32_t>(left, 0);
  if (bytes > kMaxPayload || written > kRecordHead + bytes) return false;
  return !holds_a_record(left.first(written));
}

}  // namespace evigrid::journal
