// SPDX-License-Identifier: Apache-2.0
// A map that can change its mind: it keeps its scans, and takes one back, moves its pose, puts a late one in its place,
// or takes all poses of a loop closure, by fusing anew only the tiles that are concerned. Whatever the rule and
// whatever was done, its cells are bit for bit those of a map that got the scans as they are now, in order, and nothing
// else.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/io.hpp"
#include "evigrid/journal.hpp"
#include "evigrid/map.hpp"
#include "evigrid/view.hpp"

namespace EVIGRID_API evigrid {

struct RevisableOptions {
  /// A scan at most this much older than the newest is put in its place by its stamp (equal stamps: as they came): the
  /// map is that of the sorted log. An older one is fused where it comes, as Map does, and counted; it stays there, and
  /// those that come after it are sorted as if it were not. 0 or less: none is sorted.
  std::int64_t reorder_ns = 0;
  /// A view is kept every so many scans (and four times a reorder window), so that a change need not begin with the
  /// first scan; the oldest go. They hold copies of tiles that changed since: memory for time. 0: none.
  std::size_t checkpoint_every = 256, most_checkpoints = 8;
};

struct ScanPose {
  ScanId id = 0;
  Pose2 T_map_robot{};
};

/// Calls that change the map throw std::length_error and std::system_error as Map::integrate, MapFileError when the
/// journal cannot be written, and std::invalid_argument for a scan of more than 256 MiB beside a journal. Such a call
/// was not done: map, scans and journal are as they were (but for the map of a rebuild() whose page file fails on the
/// way). Of a call with many scans the first may have been done; scans() says so.
class RevisableMap {
 public:
  /// What became of a scan.
  struct Added {
    ScanId first = 0;             ///< ids count up from here, one a scan
    std::uint64_t sorted_in = 0;  ///< late, but within the window
    std::uint64_t too_late = 0;   ///< later than that: fused where they came
    Report report;                ///< of the scans alone, not of what was fused anew around them
  };
  /// What a change cost.
  struct Revision {
    std::size_t tiles = 0;    ///< fused anew
    std::uint64_t scans = 0;  ///< that were fused anew on them
  };

  /// `map` may hold cells already: what it holds comes before all scans. With a journal it must be empty, and every
  /// call is recorded before it is done. Throws std::invalid_argument for a journal of a map with cells, with a window
  /// (Map::set_window) or with protected areas: resume() could not know of them.
  explicit RevisableMap(Map map, RevisableOptions = {}, std::optional<Journal> = {});
  ~RevisableMap();
  RevisableMap(RevisableMap&&) noexcept;
  RevisableMap& operator=(RevisableMap&&) noexcept;

  /// Where a run that ended, in whatever way, left off: what its journal holds, fused once, and recorded on.
  /// `dropped`: bytes of the record that was being written when it ended. Throws MapFileError, std::length_error and
  /// std::system_error as Map::integrate, and as Map::page_to where a page directory is given. std::invalid_argument
  /// for a region: what lies outside would be missing as soon as a scan comes.
  static RevisableMap resume(const std::filesystem::path& journal, const LoadOptions& = {}, RevisableOptions = {},
                             JournalOptions = {}, std::uint64_t* dropped = nullptr);

  Added integrate(const Scan&);
  Added integrate(std::span<const Scan>);

  /// As if it had never come. Throws std::out_of_range for an id that is not there.
  Revision remove(ScanId);
  /// As if it had come from there.
  Revision move(ScanId, const Pose2& T_map_robot);
  /// Poses of any scans, as a loop closure gives them; one pass over all scans. Throws std::out_of_range, and at the
  /// memory cap std::length_error. There must be room for the way back, too: for the map as it is, beside those of its
  /// tiles that views hold.
  Revision rebuild(std::span<const ScanPose>);

  [[nodiscard]] const Map& map() const noexcept;
  [[nodiscard]] MapView view();
  [[nodiscard]] std::size_t scans() const noexcept;
  [[nodiscard]] std::vector<ScanPose> poses() const;  ///< in the order of fusion
  [[nodiscard]] std::size_t bytes_of_scans() const noexcept;

 private:
  struct EVIGRID_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evigrid
