// SPDX-License-Identifier: Apache-2.0
// Every scan of a run in a file, in the order of their numbers, each marked fused or skipped. The file begins with the
// empty map (its parameters and sensors, as `docs/map_file.md` has it), so it needs nothing else to be fused again.
// Layout and what equals what: docs/cycle.md.
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "cycle/fleet_scan.hpp"
#include "evigrid/map.hpp"

namespace evigrid::driver {

/// Written beside and renamed by commit(); without it nothing stays. Throws InputError when it cannot be written.
class ScanLogWriter {
 public:
  /// `map` holds the sensors and no cell.
  ScanLogWriter(const std::string& path, const Map& map, std::size_t ranges_per_scan);
  ~ScanLogWriter();
  ScanLogWriter(const ScanLogWriter&) = delete;
  ScanLogWriter& operator=(const ScanLogWriter&) = delete;

  void add(const FleetScan& scan, bool fused);
  void commit();

 private:
  void put(const void* bytes, std::size_t count);
  void remove_temporary() noexcept;
  std::string path_, temporary_;
  std::ofstream out_;
  std::size_t ranges_;
  std::vector<char> record_;
  std::uint64_t scans_ = 0;
  std::uint32_t crc_ = 0;
};

struct LoggedScan {
  FleetScan scan;
  bool fused = false;
};

/// Throws InputError naming the file and, for damage, where.
class ScanLogReader {
 public:
  explicit ScanLogReader(const std::string& path);
  ~ScanLogReader();

  [[nodiscard]] std::uint64_t scans() const { return scans_; }
  [[nodiscard]] std::size_t ranges_per_scan() const { return ranges_; }
  [[nodiscard]] const std::vector<char>& map_bytes() const { return map_; }  ///< for evigrid::load

  /// The next scan; false after the last, when the checksum of the whole file was right.
  bool next(LoggedScan& scan);
  void rewind();

 private:
  [[noreturn]] void fail(const std::string& why) const;
  void get(void* bytes, std::size_t count, const char* what);
  std::string path_;
  std::ifstream in_;
  std::vector<char> map_, record_;
  std::size_t ranges_ = 0;
  std::uint64_t scans_ = 0, read_ = 0;
  std::uint32_t head_crc_ = 0, crc_ = 0;
  std::streamoff records_at_ = 0;
};

}  // namespace evigrid::driver
