// SPDX-License-Identifier: Apache-2.0
#include "cycle/replay.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <vector>

#include "cycle/fleet_run.hpp"
#include "cycle/scan_log.hpp"
#include "error.hpp"
#include "mapping.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kBatch = 1024;  // scans a call of the engine

class Replay {
 public:
  Replay(ScanLogReader& log, Replayed& out, bool pages) : log_(log), out_(out), pages_(pages), views_(out.map) {}

  /// One pass over the log, with the scans that are wanted.
  template <class Wanted>
  void pass(Wanted wanted) {
    log_.rewind();
    LoggedScan one;
    while (log_.next(one)) {
      if (!wanted(one)) continue;
      batch_.push_back(one.scan);
      if (batch_.size() == kBatch) fuse();
    }
    fuse();
  }

 private:
  void fuse() {
    if (batch_.empty()) return;
    const auto start = Clock::now();
    out_.report += integrate_what_fits(out_.map, views_.of(batch_), pages_);
    out_.fusion_s += seconds_since(start);
    out_.scans += batch_.size();
    batch_.clear();
  }
  ScanLogReader& log_;
  Replayed& out_;
  bool pages_;
  ScanViews views_;
  std::vector<FleetScan> batch_;
};

}  // namespace

ReplayPart parse_part(const std::string& text) {
  if (text == "all") return ReplayPart::all;
  if (text == "fused") return ReplayPart::fused;
  if (text == "late") return ReplayPart::late;
  throw InputError("--part: '" + text + "' is unknown; known: all, fused, late");
}

Replayed replay(const std::string& path, ReplayPart part, LoadOptions how) {
  ScanLogReader log(path);
  const bool pages = how.page_directory.has_value();
  try {
    Replayed out{load(std::as_bytes(std::span(log.map_bytes())), how, path), {}, 0, log.scans(), 0};
    std::size_t ranges = 0;
    for (const Sensor& s : out.map.sensors()) ranges += static_cast<std::size_t>(s.beams);
    if (ranges != log.ranges_per_scan()) throw InputError(path + ": its sensors do not make the ranges of its scans");
    if (out.map.tiles() != 0) throw InputError(path + ": its map is not empty");
    Replay replaying(log, out, pages);
    if (part == ReplayPart::all) replaying.pass([](const LoggedScan&) { return true; });
    if (part != ReplayPart::all) replaying.pass([](const LoggedScan& s) { return s.fused; });
    if (part == ReplayPart::late) replaying.pass([](const LoggedScan& s) { return !s.fused; });
    return out;
  } catch (const MapFileError& bad) {
    throw InputError(bad.what());
  } catch (const std::length_error& full) {
    throw InputError(fmt::format("{}: {}; more of --memory-mb or a --page-dir helps", path, full.what()));
  } catch (const std::system_error& disk) {
    throw InputError(fmt::format("--page-dir: {}", disk.what()));
  }
}

}  // namespace evigrid::driver
