// SPDX-License-Identifier: Apache-2.0
// The Lego robot of Claus Brenner's lectures on SLAM: a laser scanner, wheel ticks, and positions seen by a camera, one
// file each or all in one, blank-separated, times in ms:
//   S t 660 d1..d660                      mm, counter-clockwise; beam i (from 0) at (i − 330) · 0.006135923 rad, 1/1024
//                                         of a turn
//   M t left . . . right . . . . . . .    ticks of the wheels, running sums: fields 3 and 7 of 14; 0.349 mm a tick
//   P t x y                               mm in the camera's frame
//   L C x y diameter                      a landmark in that frame (counted, not used)
// Track 173 mm, scanner 30 mm ahead. The log holds no pose: the robot starts at the origin and its wheels are summed up
// (dead reckoning); a scan's pose lies between those of the motor records around its time. The P positions do not
// tell a heading, so they are not used as a start; the report says how far the driven way is from them after the best
// rotation and shift. Distances below 20 mm are the scanner's error codes (here 15): no return.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "error.hpp"
#include "log/dead_reckoning.hpp"
#include "log/fields.hpp"
#include "log/formats.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kBeams = 660, kScanFields = 3 + kBeams, kMotorFields = 14, kPositionFields = 4;
constexpr double kStep_rad = 0.006135923, kMm = 0.001, kTick_m = 0.349e-3, kTrack_m = 0.173, kScannerAhead_m = 0.030;
constexpr double kErrorCodesBelow_mm = 20;
constexpr double kMostStep_m = 1;  // between two motor records, a fifth of a second apart: more is a broken counter
constexpr double kMostMilliseconds = 4.5e12;  // of two the difference in nanoseconds fits 63 bits
constexpr std::int64_t kMostGap_ns = 2'000'000'000;  // a scan farther than that from every motor record has no pose

struct Recording {
  std::vector<TimedPose> way;
  double last_left = 0, last_right = 0;  ///< ticks
  std::vector<TimedPosition> reference;
  std::vector<std::size_t> scan_lines;  ///< of the scans in the log, for messages
  std::string scan_file;
};

Sensor scanner() {
  Sensor s;
  s.model = Model::beam;
  s.T_robot_sensor = {kScannerAhead_m, 0, 0};
  s.beams = static_cast<int>(kBeams);
  s.first_beam_rad = -330 * kStep_rad;
  s.beam_step_rad = kStep_rad;
  s.min_range_m = 0.06;
  s.max_range_m = 4.0;
  return s;
}

std::int64_t milliseconds(const Tokens& t, std::size_t at) {
  const double ms = number(t, at);
  if (!(std::abs(ms) < kMostMilliseconds)) throw Malformed{"bad number", "the time stamp is no time"};
  return std::llround(ms * 1e6);
}

void read_scan(const Tokens& t, Log& log, std::vector<float>& scratch) {
  expect_fields(t.size(), kScanFields);
  if (number(t, 2) != kBeams) throw Malformed{"wrong count", fmt::format("{} beams are stated, not 660", t[2])};
  const std::int64_t stamp = milliseconds(t, 1);
  scratch.clear();
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double mm = number(t, 3 + i);
    const bool code = mm >= 0 && mm < kErrorCodesBelow_mm;
    scratch.push_back(code ? std::numeric_limits<float>::infinity() : range_m(mm * kMm, log));
  }
  append_fan(log, sensor_index(log, "laser", scanner()), stamp, {}, scratch);
}

void read_motors(const Tokens& t, Recording& r) {
  expect_fields(t.size(), kMotorFields);
  const std::int64_t stamp = milliseconds(t, 1);
  const double left = finite_number(t, 2), right = finite_number(t, 6);
  if (r.way.empty()) {
    r.way.push_back({stamp, {}});
  } else {
    if (stamp < r.way.back().stamp_ns) throw Malformed{"time backwards", "a motor record before the last one"};
    const double left_m = (left - r.last_left) * kTick_m, right_m = (right - r.last_right) * kTick_m;
    if (!(std::abs(left_m) <= kMostStep_m && std::abs(right_m) <= kMostStep_m)) {
      throw Malformed{"absurd step", fmt::format("the wheels went {:g} m and {:g} m at once", left_m, right_m)};
    }
    r.way.push_back({stamp, driven(r.way.back().pose, left_m, right_m, kTrack_m)});
  }
  r.last_left = left;
  r.last_right = right;
}

void read_file(const Source& source, Log& log, Recording& r) {
  std::vector<float> scratch;
  for_each_record(source, ' ', kScanFields, log, [&](const Tokens& t, std::size_t line) {
    if (t[0] == "S") {
      read_scan(t, log, scratch);
      r.scan_lines.push_back(line);
      r.scan_file = source.name;
    } else if (t[0] == "M") {
      read_motors(t, r);
    } else if (t[0] == "P") {
      expect_fields(t.size(), kPositionFields);
      r.reference.push_back({milliseconds(t, 1), finite_number(t, 2) * kMm, finite_number(t, 3) * kMm});
    } else {
      log.skip(t[0]);
    }
  });
}

/// Gives every scan its pose; those without a motor record near are dropped and counted.
void place_scans(Log& log, const Recording& r) {
  std::vector<LogScan> placed;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    LogScan scan = log.scans[i];
    if (r.way.empty() || scan.stamp_ns < r.way.front().stamp_ns - kMostGap_ns ||
        scan.stamp_ns > r.way.back().stamp_ns + kMostGap_ns) {
      log.reject(r.scan_file, r.scan_lines[i], "no pose", "no motor record near its time");
      continue;
    }
    scan.T_map_robot = pose_at(r.way, scan.stamp_ns);
    placed.push_back(scan);
  }
  log.scans = std::move(placed);
}

bool looks_like_lego(const FirstLine& line) {
  double ignored = 0;
  const std::string_view keyword = line.blanks[0];
  return (keyword == "S" || keyword == "M" || keyword == "P") && line.blanks.size() >= kPositionFields &&
         parse_number(line.blanks[1], ignored) && parse_number(line.blanks[2], ignored);
}

constexpr const char* kScan = "scan.txt";
constexpr const char* kMotors = "motors.txt";
constexpr const char* kReference = "reference.txt";

/// Files of a folder whose name ends like that, sorted.
std::vector<std::string> ending(const fs::path& folder, std::string_view end) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().ends_with(end)) out.push_back(entry.path().string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool lego_folder(const fs::path& folder) { return !ending(folder, kScan).empty() && !ending(folder, kMotors).empty(); }

/// A folder, one file that is or has the others beside it, or all files named.
std::vector<Source> lego_files(std::span<const Source> named) {
  if (named.size() > 1 || !fs::exists(named.front().name)) return {named.begin(), named.end()};
  std::string stem = named.front().name;
  if (fs::is_directory(stem)) {
    const auto scans = ending(stem, kScan);
    if (scans.size() != 1) {
      throw InputError(fmt::format("{}: holds {} files *{}, not one: name the files", stem, scans.size(), kScan));
    }
    stem = scans.front();
  }
  bool one_of_several = false;
  for (const std::string_view end : {kScan, kMotors, kReference}) {
    if (!one_of_several && stem.ends_with(end)) {
      stem.resize(stem.size() - end.size());
      one_of_several = true;
    }
  }
  if (!one_of_several) return {named.front()};
  std::vector<Source> out{{stem + kScan}, {stem + kMotors}};
  if (fs::exists(stem + kReference)) out.push_back({stem + kReference});
  return out;
}

void read_lego(std::span<const Source> sources, Log& log) {
  log.poses = Poses::dead_reckoned;
  Recording recording;
  for (const Source& source : sources) read_file(source, log, recording);
  place_scans(log, recording);
  if (const ReferenceFit fit = fit_reference(recording.way, recording.reference); fit.points >= 2) {
    log.facts["reference_points"] = static_cast<double>(fit.points);
    log.facts["reference_deviation_rms_m"] = fit.rms_m;
    log.facts["reference_deviation_max_m"] = fit.max_m;
    log.facts["reference_yaw_deg"] = fit.yaw_rad / kDeg;
  }
}

}  // namespace

const Format kLego{"lego",
                   "laser and wheel ticks, Brenner's Lego robot: a folder with *scan.txt and *motors.txt, or the files",
                   looks_like_lego,
                   lego_folder,
                   lego_files,
                   4,
                   read_lego};

}  // namespace evigrid::driver
