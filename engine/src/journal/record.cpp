// SPDX-License-Identifier: Apache-2.0
#include "journal/record.hpp"

#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <stdexcept>

#include "io/layout.hpp"

namespace evigrid::journal {
namespace {

void put_double(io::Bytes& out, double v) { out.put(std::bit_cast<std::uint64_t>(v)); }
void put_pose(io::Bytes& out, const Pose2& p) {
  put_double(out, p.x_m), put_double(out, p.y_m), put_double(out, p.yaw_rad);
}
std::vector<std::byte> taken(const io::Bytes& out) { return {out.get().begin(), out.get().end()}; }

/// Reads on, and knows where the bytes end.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T number() {
    const T v = io::number_at<T>(take(sizeof(T)), 0);
    return v;
  }
  double real() { return std::bit_cast<double>(number<std::uint64_t>()); }
  Pose2 pose() {
    const double x = real(), y = real(), yaw = real();
    return {x, y, yaw};
  }
  std::span<const std::byte> take(std::size_t n) {
    if (n > left()) throw std::invalid_argument("is shorter than it says");
    const auto out = bytes_.first(n);
    bytes_ = bytes_.subspan(n);
    return out;
  }
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
};

std::vector<std::byte> decompressed(std::span<const std::byte> frame) {
  const auto size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size > kMaxPayload) throw std::invalid_argument("cannot be decompressed");  // also for its two error values
  std::vector<std::byte> out(static_cast<std::size_t>(size));
  const std::size_t n = ZSTD_decompress(out.data(), out.size(), frame.data(), frame.size());
  if (ZSTD_isError(n) || n != out.size()) throw std::invalid_argument("cannot be decompressed");
  return out;
}

KeptScan decode_scan(Cursor in) {
  const auto stamp = in.number<std::int64_t>();
  const Pose2 pose = in.pose();
  const std::size_t readings = in.number<std::uint32_t>();
  if (readings > in.left() / 8) throw std::invalid_argument("is shorter than it says");
  std::vector<SensorId> sensors(readings);
  std::vector<std::uint32_t> counts(readings);
  std::size_t all = 0;
  for (std::size_t i = 0; i < readings; ++i) {
    sensors[i] = in.number<std::uint32_t>();
    counts[i] = in.number<std::uint32_t>();
    all += counts[i];
  }
  if (in.left() != all * sizeof(float)) throw std::invalid_argument("holds another number of ranges than it says");
  std::vector<float> ranges(all);
  for (float& r : ranges) r = std::bit_cast<float>(in.number<std::uint32_t>());
  return {stamp, pose, std::move(sensors), std::move(counts), std::move(ranges)};
}

}  // namespace

std::uint32_t record_crc(std::span<const std::byte> first16, std::span<const std::byte> payload) noexcept {
  // Two checksums in one: the payload's is the last thing that the head's covers.
  std::array<std::byte, 20> all;
  std::copy(first16.begin(), first16.end(), all.begin());
  const std::uint32_t of_payload = io::crc32(payload);
  for (std::size_t i = 0; i < 4; ++i) all[16 + i] = static_cast<std::byte>(of_payload >> (8 * i));
  return io::crc32(all);
}

bool is_whole(std::span<const std::byte> in) noexcept {
  const std::size_t bytes = io::number_at<std::uint32_t>(in, 0);
  return bytes <= in.size() - kRecordHead &&
         record_crc(in.first(16), in.subspan(kRecordHead, bytes)) == io::number_at<std::uint32_t>(in, 16);
}

bool is_kind(std::uint32_t kind) noexcept {
  kind &= ~kCompressed;
  return kind >= static_cast<std::uint32_t>(JournalEvent::Kind::scan) &&
         kind <= static_cast<std::uint32_t>(JournalEvent::Kind::move);
}

std::vector<std::byte> encode(JournalEvent::Kind kind, ScanId id, std::span<const std::byte> payload, bool compress) {
  const auto limit = [](std::size_t bytes) {  // of the reader, who holds both sizes against it
    if (bytes > kMaxPayload) throw std::invalid_argument("journal: a scan is too large for a record");
  };
  limit(payload.size());
  std::vector<std::byte> frame;
  if (compress) {
    frame.resize(ZSTD_compressBound(payload.size()));
    const std::size_t n = ZSTD_compress(frame.data(), frame.size(), payload.data(), payload.size(), 1);
    if (ZSTD_isError(n)) throw std::bad_alloc();
    payload = std::span<const std::byte>(frame).first(n);
    limit(n);
  }
  io::Bytes head;
  head.put(static_cast<std::uint32_t>(payload.size()));
  head.put(static_cast<std::uint32_t>(kind) + (compress ? kCompressed : 0));
  head.put(id);
  head.put(record_crc(head.get(), payload));
  std::vector<std::byte> out = taken(head);
  out.insert(out.end(), payload.begin(), payload.end());
  return out;
}

std::vector<std::byte> scan_payload(const Scan& s) {
  io::Bytes out;
  out.put(s.stamp_ns);
  put_pose(out, s.T_map_robot);
  out.put(static_cast<std::uint32_t>(s.readings.size()));
  std::size_t all = 0;
  for (const Reading& r : s.readings) {
    out.put(r.sensor);
    out.put(static_cast<std::uint32_t>(r.ranges_m.size()));
    all += r.ranges_m.size();
  }
  std::size_t at = out.get().size();
  std::vector<std::byte> bytes(at + all * sizeof(float));
  std::copy(out.get().begin(), out.get().end(), bytes.begin());
  for (const Reading& r : s.readings) {
    for (const float range : r.ranges_m) {
      const auto bits = std::bit_cast<std::uint32_t>(range);
      for (std::size_t i = 0; i < 4; ++i) bytes[at++] = static_cast<std::byte>(bits >> (8 * i));
    }
  }
  return bytes;
}

std::vector<std::byte> pose_payload(const Pose2& p) {
  io::Bytes out;
  put_pose(out, p);
  return taken(out);
}

JournalEvent decode(std::uint32_t kind, ScanId id, std::span<const std::byte> payload) {
  std::vector<std::byte> plain;
  if ((kind & kCompressed) != 0) {
    plain = decompressed(payload);
    payload = plain;
    kind &= ~kCompressed;
  }
  JournalEvent out;
  out.id = id;
  out.kind = static_cast<JournalEvent::Kind>(kind);
  switch (kind) {
    case 1:
      out.scan = decode_scan(Cursor(payload));
      break;
    case 2:
      if (!payload.empty()) throw std::invalid_argument("holds more than it should");
      break;
    case 3: {
      Cursor in(payload);
      out.T_map_robot = in.pose();
      if (in.left() != 0) throw std::invalid_argument("holds more than it should");
      break;
    }
    default:
      throw std::invalid_argument("is of a kind that this program does not know");
  }
  return out;
}

}  // namespace evigrid::journal
