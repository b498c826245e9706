// SPDX-License-Identifier: Apache-2.0
// A journal: every scan, as it came, appended to a file before it is fused, so that a run that was killed goes on with
// nothing lost. Checksummed record by record; docs/life_of_a_map.md has the layout.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/io.hpp"
#include "evigrid/map.hpp"
#include "evigrid/scan.hpp"

namespace EVIGRID_API evigrid {

/// Names a scan in a journal and in a RevisableMap; 0 is none.
using ScanId = std::uint64_t;

/// A scan with memory of its own, as it passes queues and stays in journals. Moves are cheap and leave scan() valid.
class KeptScan {
 public:
  KeptScan() = default;
  explicit KeptScan(const Scan&);
  /// ranges_m: counts[0] of sensors[0], then counts[1] of sensors[1] and so on, m. Throws std::invalid_argument for
  /// fewer of them, std::out_of_range for fewer counts than sensors.
  KeptScan(std::int64_t stamp_ns, const Pose2& T_map_robot, std::vector<SensorId> sensors,
           std::vector<std::uint32_t> counts, std::vector<float> ranges_m);
  KeptScan(KeptScan&&) noexcept = default;
  KeptScan& operator=(KeptScan&&) noexcept = default;
  /// As the map takes it; refers to this object.
  [[nodiscard]] Scan scan() const noexcept { return {stamp_ns, T_map_robot, readings_}; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return ranges_m_.size() * sizeof(float) + readings_.size() * sizeof(Reading);
  }
  std::int64_t stamp_ns = 0;
  Pose2 T_map_robot{};

 private:
  std::vector<float> ranges_m_;
  std::vector<Reading> readings_;
};

struct JournalOptions {
  /// Records through zstd (level 1): about half the bytes for lasers, at several times the time.
  bool compress = false;
  /// fsync after each record: it then outlives a power failure, not only the process. Without it a record outlives the
  /// process as soon as the call returns, and the machine when the system has written it.
  bool sync_each = false;
};

/// What happened, in order.
struct JournalEvent {
  enum class Kind : std::uint8_t { scan = 1, remove = 2, move = 3 } kind = Kind::scan;
  ScanId id = 0;
  KeptScan scan{};      ///< of a scan
  Pose2 T_map_robot{};  ///< of a move
};
struct JournalContents {
  MapParams params;
  std::vector<Sensor> sensors;
  std::vector<JournalEvent> events;
  std::uint64_t bytes = 0;    ///< up to the end of the last whole record
  std::uint64_t dropped = 0;  ///< bytes of a record that was cut short behind it: what was being written at the end
};

/// Throws MapFileError for what is no journal and for damage in its middle, with the place and how many scans come
/// before it. A record that is cut short at the end of the file, or turns to zeros there, is no damage: it is dropped
/// and counted. No record that can still be read is.
[[nodiscard]] JournalContents read_journal(const std::filesystem::path& path);
[[nodiscard]] JournalContents read_journal(std::span<const std::byte>, std::string_view name = "journal");

/// Whether the journal is of maps like this one; kernel and memory cap belong to the machine and may differ.
[[nodiscard]] bool fits(const JournalContents&, const MapParams&, std::span<const Sensor>);

/// The writer. One thread at a time. Every call returns when the record is with the operating system; of one that
/// throws nothing is recorded. They throw MapFileError when the file cannot be written.
class Journal {
 public:
  /// A new file for maps with these parameters and sensors. Throws MapFileError when it exists or cannot be written:
  /// then there is none. Its name is brought to the disk.
  static Journal create(const std::filesystem::path& path, const MapParams&, std::span<const Sensor>,
                        JournalOptions = {});
  /// Goes on behind what was read; a record that was cut short is cut off. Throws MapFileError when the file cannot be
  /// opened or cut.
  static Journal append(const std::filesystem::path& path, const JournalContents& read, JournalOptions = {});
  ~Journal();
  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;

  void add(ScanId, const Scan&);  ///< std::invalid_argument for a scan of more than 256 MiB
  void remove(ScanId);
  void move(ScanId, const Pose2& T_map_robot);
  void sync();                                         ///< to the disk
  [[nodiscard]] std::uint64_t bytes() const noexcept;  ///< of the file
  /// Takes back what was recorded since bytes() was this: for what could not be done after all. Where the file cannot
  /// be cut the calls above throw from then on.
  void cut(std::uint64_t bytes) noexcept;

 private:
  struct EVIGRID_LOCAL Impl;
  explicit Journal(std::unique_ptr<Impl>);
  std::unique_ptr<Impl> impl_;
};

}  // namespace evigrid
