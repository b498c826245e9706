// SPDX-License-Identifier: Apache-2.0
// The ring of eight sonars, published as two files of blank-separated integers:
//   poses.txt        t_ms x_mm y_mm theta_decidegrees (counter-clockwise)
//   measurement.txt  t_ms z0..z7 mm; 5110 = no echo
// A measurement belongs to the pose with its time stamp: normally the same line, otherwise wherever it is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "error.hpp"
#include "log/fields.hpp"
#include "log/formats.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kSonars = 8;
constexpr double kBearing_rad[kSonars] = {-90 * kDeg, -37.5 * kDeg, -22.5 * kDeg, -7.5 * kDeg,
                                          7.5 * kDeg, 22.5 * kDeg,  37.5 * kDeg,  90 * kDeg};
constexpr double kNoEcho_mm = 5110;

constexpr double kMostMilliseconds = 4.5e12;  // of two the difference in nanoseconds fits 63 bits
constexpr const char* kPosesFile = "poses.txt";
constexpr const char* kMeasurementsFile = "measurement.txt";
constexpr std::size_t kPoseFields = 4, kMeasurementFields = 1 + kSonars;

/// Reads rows of `width` numbers; calls row(values) for each good one and counts the others.
template <class Row>
void for_each_row(const Source& source, std::size_t width, Log& log, Row row) {
  std::vector<double> values(width);
  for_each_record(source, ' ', width, log, [&](const Tokens& tokens, std::size_t) {
    expect_fields(tokens.size(), width);
    for (std::size_t at = 0; at < width; ++at) values[at] = number(tokens, at);
    if (!(std::abs(values[0]) < kMostMilliseconds)) throw Malformed{"bad number", "the time stamp is no time"};
    row(values);
  });
}

void add_sonars(Log& log) {
  for (const double bearing_rad : kBearing_rad) {
    Sensor s;
    s.model = Model::li2014;
    s.T_robot_sensor = {0, 0, bearing_rad};
    s.aperture_rad = 20 * kDeg;
    s.min_range_m = 0.17;
    s.max_range_m = 5.0;
    s.no_return_m = kNoEcho_mm / 1000;
    log.sensors.push_back({"sonar", s});
  }
}

bool looks_like_ring8(const FirstLine& line) {
  double ignored = 0;
  const bool width = line.blanks.size() == kPoseFields || line.blanks.size() == kMeasurementFields;
  return width && std::all_of(line.blanks.begin(), line.blanks.end(),
                              [&](std::string_view token) { return parse_number(token, ignored); });
}

/// Fields of the first record when it starts with a number, else 0.
std::size_t numeric_columns(const Source& source) {
  LineReader lines(source);
  std::string_view line;
  Tokens tokens;
  double ignored = 0;
  while (lines.next(line)) {
    split(line, tokens, kMeasurementFields);
    if (tokens.empty() || tokens[0].front() == '#') continue;
    return parse_number(tokens[0], ignored) ? tokens.size() : 0;
  }
  return 0;
}

/// The two files of a ring from whatever the user named: the folder, one file, or both in any order.
std::vector<Source> ring_files(std::span<const Source> named) {
  if (named.size() > 2) throw InputError("format ring8 takes a folder, one file or two files");
  if (named.size() == 2) {
    const bool swapped =
        fs::path(named[0].name).filename() == kMeasurementsFile || numeric_columns(named[0]) == kMeasurementFields;
    return swapped ? std::vector<Source>{named[1], named[0]} : std::vector<Source>{named[0], named[1]};
  }
  const fs::path given = named.front().name;
  const fs::path folder = fs::is_directory(given) ? given : given.parent_path();
  Source poses{(folder / kPosesFile).string()}, measurements{(folder / kMeasurementsFile).string()};
  if (!fs::is_directory(given)) {
    (numeric_columns(named.front()) == kPoseFields ? poses : measurements) = named.front();
  }
  return {poses, measurements};
}

bool ring_folder(const fs::path& folder) {
  return fs::exists(folder / kPosesFile) || fs::exists(folder / kMeasurementsFile);
}

/// A reading as the log will hold it.
float reading_m(double mm, Log& log) {
  return mm == kNoEcho_mm ? std::numeric_limits<float>::infinity() : range_m(mm / 1000, log);
}

/// The poses by their time stamps. A stamp may occur twice: first come, first served.
class Poses8 {
 public:
  void add(std::int64_t stamp_ms, const Pose2& pose) { rows_.push_back({stamp_ms, pose}); }
  void sort() {
    std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.stamp_ms < b.stamp_ms; });
  }
  /// The next pose of that time, if there is one left.
  const Pose2* take(std::int64_t stamp_ms) {
    const auto first = std::lower_bound(rows_.begin(), rows_.end(), stamp_ms,
                                        [](const Row& row, std::int64_t stamp) { return row.stamp_ms < stamp; });
    if (first == rows_.end()) return nullptr;
    const auto left = static_cast<std::size_t>(rows_.end() - first);
    if (first->taken >= left || first[static_cast<std::ptrdiff_t>(first->taken)].stamp_ms != stamp_ms) return nullptr;
    return &first[static_cast<std::ptrdiff_t>(first->taken++)].pose;
  }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

 private:
  struct Row {
    std::int64_t stamp_ms;
    Pose2 pose;
    std::size_t taken = 0;  ///< of the rows with this stamp: counted in the first of them
  };
  std::vector<Row> rows_;
};

void read_ring8(std::span<const Source> sources, Log& log) {
  if (sources.size() != 2) throw InputError("format ring8 needs two files: poses and measurements");
  Poses8 poses;
  std::size_t matched = 0;
  for_each_row(sources[0], kPoseFields, log, [&](const std::vector<double>& v) {
    poses.add(std::llround(v[0]), {v[1] / 1000, v[2] / 1000, v[3] / 10 * kDeg});
  });
  poses.sort();
  add_sonars(log);
  std::vector<float> ranges(kSonars);
  for_each_row(sources[1], kMeasurementFields, log, [&](const std::vector<double>& v) {
    const std::int64_t stamp_ms = std::llround(v[0]);
    const Pose2* const pose = poses.take(stamp_ms);
    if (pose == nullptr) throw Malformed{"no pose", fmt::format("no pose has the time stamp {}", stamp_ms)};
    for (std::size_t i = 0; i < kSonars; ++i) ranges[i] = reading_m(v[1 + i], log);
    append_cones(log, 0, stamp_ms * 1'000'000, *pose, ranges);
    ++matched;
  });
  if (poses.size() > matched) log.malformed["no measurement"] += poses.size() - matched;
}

}  // namespace

const Format kRing8{
    "ring8",          "ring of eight sonars: a folder with poses.txt and measurement.txt, or either file",
    looks_like_ring8, ring_folder,
    ring_files,       2,
    read_ring8};

}  // namespace evigrid::driver
