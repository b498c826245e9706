// SPDX-License-Identifier: Apache-2.0
// Little-endian, like every machine that this builds on; magic, sizes, empty map, records of one length, count, CRC-32.
#include "cycle/scan_log.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "error.hpp"
#include "evigrid/io.hpp"

namespace evigrid::driver {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMagic{'E', 'V', 'I', 'S', 'C', 'A', 'N', '1'};
constexpr std::uint64_t kMostMapBytes = 1 << 20;  // an empty map: a header and its sensors
constexpr std::uint32_t kMostRanges = 1 << 20;

/// What a record begins with; the ranges follow.
struct Head {
  std::uint64_t number;
  std::int64_t stamp_ns;
  std::uint32_t robot, fused;
  double x_m, y_m, yaw_rad;
};
static_assert(sizeof(Head) == 48);

struct Sizes {
  std::uint32_t ranges, map_bytes;
};
struct Tail {
  std::uint64_t scans;
  std::uint32_t crc, zero;
};

std::uint32_t add_crc(std::uint32_t crc, const void* bytes, std::size_t count) {
  return static_cast<std::uint32_t>(::crc32(crc, static_cast<const Bytef*>(bytes), static_cast<uInt>(count)));
}

}  // namespace

ScanLogWriter::ScanLogWriter(const std::string& path, const Map& map, std::size_t ranges_per_scan)
    : path_(path), temporary_(fmt::format("{}.tmp-{}", path, ::getpid())), ranges_(ranges_per_scan) {
  const auto status = std::filesystem::status(path_);
  if (std::filesystem::is_directory(status)) throw InputError(path_ + ": cannot be written: a folder has that name");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path_ + ": cannot be written: it is a device or a pipe");
  out_.open(temporary_, std::ios::binary);
  std::ostringstream empty_map;
  save(map, empty_map);
  const std::string bytes = empty_map.str();
  const Sizes sizes{static_cast<std::uint32_t>(ranges_), static_cast<std::uint32_t>(bytes.size())};
  try {
    put(kMagic.data(), kMagic.size());
    put(&sizes, sizeof sizes);
    put(bytes.data(), bytes.size());
  } catch (...) {
    remove_temporary();
    throw;
  }
  record_.resize(sizeof(Head) + ranges_ * sizeof(float));
}

ScanLogWriter::~ScanLogWriter() { remove_temporary(); }

void ScanLogWriter::remove_temporary() noexcept {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void ScanLogWriter::put(const void* bytes, std::size_t count) {
  crc_ = add_crc(crc_, bytes, count);
  out_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  if (!out_) throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
}

void ScanLogWriter::add(const FleetScan& scan, bool fused) {
  const Pose2& p = scan.T_map_robot;
  const Head head{scan.number, scan.stamp_ns, scan.robot, fused ? 1u : 0u, p.x_m, p.y_m, p.yaw_rad};
  std::memcpy(record_.data(), &head, sizeof head);
  std::memcpy(record_.data() + sizeof head, scan.ranges_m.data(), ranges_ * sizeof(float));
  put(record_.data(), record_.size());
  ++scans_;
}

void ScanLogWriter::commit() {
  put(&scans_, sizeof scans_);
  const std::uint32_t end[2]{crc_, 0};
  out_.write(reinterpret_cast<const char*>(end), sizeof end);
  out_.close();
  std::error_code error;
  if (out_) std::filesystem::rename(temporary_, path_, error);
  if (!out_ || error)
    throw InputError(path_ + ": cannot be written: " + (error ? error.message() : "the disk may be full"));
  temporary_.clear();
}

ScanLogReader::ScanLogReader(const std::string& path) : path_(path), in_(path, std::ios::binary) {
  const int error = in_ ? 0 : errno;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw InputError(path + ": is a folder, no scan log");
  if (error != 0) throw InputError(fmt::format("{}: cannot be read: {}", path, std::strerror(error)));
  std::array<char, 8> magic{};
  Sizes sizes{};
  get(magic.data(), magic.size(), "its head");
  if (magic != kMagic) throw InputError(path + ": is no scan log of evigrid");
  get(&sizes, sizeof sizes, "its head");
  ranges_ = sizes.ranges;
  if (sizes.map_bytes > kMostMapBytes || ranges_ == 0 || ranges_ > kMostRanges) fail("its head names absurd sizes");
  map_.resize(sizes.map_bytes);
  get(map_.data(), map_.size(), "its sensors");
  head_crc_ = crc_;
  records_at_ = in_.tellg();
  record_.resize(sizeof(Head) + ranges_ * sizeof(float));
  const std::uint64_t size = std::filesystem::file_size(path), before = static_cast<std::uint64_t>(records_at_);
  if (size < before + sizeof(Tail)) fail("it is cut off");
  in_.seekg(-static_cast<std::streamoff>(sizeof(Tail)), std::ios::end);
  in_.read(reinterpret_cast<char*>(&scans_), sizeof scans_);
  const std::uint64_t room = size - before - sizeof(Tail);
  if (room % record_.size() != 0 || scans_ != room / record_.size())
    fail(fmt::format("it is cut off or damaged: it has room for {} scans and says {}", room / record_.size(), scans_));
  rewind();
}
ScanLogReader::~ScanLogReader() = default;

void ScanLogReader::rewind() {
  in_.clear();
  in_.seekg(records_at_);
  read_ = 0;
  crc_ = head_crc_;
}

void ScanLogReader::fail(const std::string& why) const { throw InputError(path_ + ": " + why); }

void ScanLogReader::get(void* bytes, std::size_t count, const char* what) {
  in_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count));
  if (!in_) fail(fmt::format("it is cut off in {}", what));
  crc_ = add_crc(crc_, bytes, count);
}

bool ScanLogReader::next(LoggedScan& out) {
  if (read_ == scans_) {
    Tail tail{};
    get(&tail.scans, sizeof tail.scans, "its end");
    const std::uint32_t right = crc_;
    get(&tail.crc, sizeof tail.crc + sizeof tail.zero, "its end");
    if (tail.crc != right || tail.zero != 0) fail("its checksum is wrong");
    return false;
  }
  get(record_.data(), record_.size(), "a record");
  Head head{};
  std::memcpy(&head, record_.data(), sizeof head);
  if (head.fused > 1) fail(fmt::format("record {} is damaged", read_));
  ++read_;
  out.fused = head.fused == 1;
  out.scan.number = head.number;
  out.scan.stamp_ns = head.stamp_ns;
  out.scan.robot = head.robot;
  out.scan.T_map_robot = {head.x_m, head.y_m, head.yaw_rad};
  out.scan.ranges_m.resize(ranges_);
  std::memcpy(out.scan.ranges_m.data(), record_.data() + sizeof head, ranges_ * sizeof(float));
  return true;
}

}  // namespace evigrid::driver
