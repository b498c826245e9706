// SPDX-License-Identifier: Apache-2.0
#include "map_journal.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>

#include "error.hpp"

namespace evigrid::driver {
namespace {

bool same_bits(const Scan& a, const Scan& b) {
  if (a.stamp_ns != b.stamp_ns || std::memcmp(&a.T_map_robot, &b.T_map_robot, sizeof(Pose2)) != 0 ||
      a.readings.size() != b.readings.size())
    return false;
  for (std::size_t i = 0; i < a.readings.size(); ++i) {
    const Reading &p = a.readings[i], &q = b.readings[i];
    if (p.sensor != q.sensor || p.ranges_m.size() != q.ranges_m.size() ||
        std::memcmp(p.ranges_m.data(), q.ranges_m.data(), p.ranges_m.size_bytes()) != 0)
      return false;
  }
  return true;
}

}  // namespace

MapJournal::MapJournal(const JournalFile& file, const Map& map, std::span<const Scan> log) : path_(file.path) {
  if (path_.empty()) return;
  try {
    if (!file.resume) {
      std::error_code ignored;
      if (std::filesystem::exists(path_, ignored))
        throw InputError(fmt::format("--journal: {} exists already; --resume goes on with it", path_));
      journal_ = Journal::create(path_, map.params(), map.sensors());
      return;
    }
    const JournalContents was = read_journal(path_);
    if (!fits(was, map.params(), map.sensors()))
      throw InputError(fmt::format("--resume: {} is of a map with other parameters or sensors", path_));
    known_ = was.events.size();
    dropped_ = was.dropped;
    for (std::size_t i = 0; i < known_; ++i) {
      if (was.events[i].kind != JournalEvent::Kind::scan || i >= log.size() ||
          !same_bits(was.events[i].scan.scan(), log[i]))
        throw InputError(fmt::format("--resume: record {} of {} is not scan {} of this log", i, path_, i));
    }
    journal_ = Journal::append(path_, was);
  } catch (const MapFileError& bad) {
    throw InputError(bad.what());
  }
}

void MapJournal::record(std::size_t first, std::span<const Scan> scans) {
  if (!journal_) return;
  try {
    for (std::size_t i = first < known_ ? std::min(known_ - first, scans.size()) : 0; i < scans.size(); ++i)
      journal_->add(first + i + 1, scans[i]);
  } catch (const MapFileError& bad) {
    throw InputError(bad.what());
  }
}

nlohmann::ordered_json MapJournal::facts() const {
  if (!journal_) return nullptr;
  return {{"file", path_}, {"bytes", journal_->bytes()}, {"scans_resumed", known_}, {"bytes_dropped", dropped_}};
}

}  // namespace evigrid::driver
