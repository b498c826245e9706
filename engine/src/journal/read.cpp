// SPDX-License-Identifier: Apache-2.0
// Nothing is believed before its checksum. What was being written when the process or the machine died is at the end
// (tail.hpp) and dropped.
#include <algorithm>
#include <fstream>

#include "io/header.hpp"
#include "io/layout.hpp"
#include "journal/record.hpp"
#include "journal/tail.hpp"

namespace evigrid {
namespace {

using Bytes = std::span<const std::byte>;

/// Parameters and sensors; answers where the records begin.
std::size_t read_head(Bytes in, std::string_view name, JournalContents& out) {
  const auto fail = [&](const std::string& why) { throw MapFileError(name, why); };
  if (in.size() < io::kHeadBytes) fail(in.empty() ? "is empty" : "is not an evigrid journal");
  if (!std::equal(journal::kMagic.begin(), journal::kMagic.end(), in.begin(),
                  [](std::uint8_t a, std::byte b) { return std::byte{a} == b; }))
    fail("is not an evigrid journal");
  if (io::crc32(in.first(20)) != io::number_at<std::uint32_t>(in, 20)) fail("checksum of the head is wrong");
  const auto version = io::number_at<std::uint32_t>(in, 8);
  if (version != journal::kVersion)
    fail("has format version " + std::to_string(version) + ", this program knows " + std::to_string(journal::kVersion));
  const std::size_t text_bytes = io::number_at<std::uint32_t>(in, 12);
  if (text_bytes > in.size() - io::kHeadBytes) fail("is truncated in its header");
  const Bytes text = in.subspan(io::kHeadBytes, text_bytes);
  if (io::crc32(text) != io::number_at<std::uint32_t>(in, 16)) fail("checksum of the header is wrong");
  try {
    MapFileInfo info = io::parse_header({reinterpret_cast<const char*>(text.data()), text.size()});
    out.params = info.params;
    out.sensors = std::move(info.sensors);
  } catch (const std::invalid_argument& bad) {
    fail(bad.what());
  }
  return io::kHeadBytes + text_bytes;
}

}  // namespace

JournalContents read_journal(Bytes in, std::string_view name) {
  JournalContents out;
  std::size_t at = read_head(in, name, out), scans = 0;
  while (at < in.size()) {
    const Bytes left = in.subspan(at);
    const auto damaged = [&](const std::string& why) {
      throw MapFileError(name, "record at byte " + std::to_string(at) + " " + why + "; " + std::to_string(scans) +
                                   " scans come before it");
    };
    if (left.size() < journal::kRecordHead || !journal::is_whole(left)) {
      if (journal::is_torn_tail(left)) break;
      damaged("has a wrong length or checksum");
    }
    const Bytes payload = left.subspan(journal::kRecordHead, io::number_at<std::uint32_t>(left, 0));
    try {
      out.events.push_back(
          journal::decode(io::number_at<std::uint32_t>(left, 4), io::number_at<std::uint64_t>(left, 8), payload));
    } catch (const std::invalid_argument& bad) {
      damaged(bad.what());
    }
    scans += out.events.back().kind == JournalEvent::Kind::scan;
    at += journal::kRecordHead + payload.size();
  }
  out.bytes = at;
  out.dropped = in.size() - at;
  return out;
}

bool fits(const JournalContents& journal, const MapParams& params, std::span<const Sensor> sensors) {
  const auto text = [](MapParams p, std::span<const Sensor> s) {
    p.kernel = Kernel::automatic;
    p.memory_cap_bytes = 0;
    MapFileInfo info;
    info.params = p;
    info.sensors.assign(s.begin(), s.end());
    return io::header_text(info);
  };
  return text(journal.params, journal.sensors) == text(params, sensors);
}

JournalContents read_journal(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw MapFileError(path.string(), "is a folder, not a journal");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw MapFileError(path.string(), "cannot be opened");
  const std::streamoff size = file.tellg();
  if (size < 0) throw MapFileError(path.string(), "cannot be read");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw MapFileError(path.string(), "cannot be read");
  return read_journal(bytes, path.string());
}

}  // namespace evigrid
