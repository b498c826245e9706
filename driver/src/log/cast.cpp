// SPDX-License-Identifier: Apache-2.0
// The readings that `evigrid cast --sensors` writes, or any program:
//   # sensor 0 kind=sonar model=li2014 x_m=0.2 …        one line a sensor (sensor_line.hpp)
//   step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m[,truth][,beam][,odom_x_m,odom_y_m,odom_yaw_rad]
// Rows of one step are one scan; beams of a laser follow one another from 0 on. The pose is that of odom_…, where there
// is one: what the robot knew.
#include <charconv>
#include <optional>

#include "log/formats.hpp"
#include "log/sensor_line.hpp"
#include "log/table.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kMostColumns = 32, kMostSensors = 4096;
constexpr std::int64_t kMostStamp_ns = 4'500'000'000'000'000'000;  // the difference of two fits 63 bits

bool looks_like_cast(const FirstLine& line) {
  return line.commas.size() > 6 && line.commas[0] == "step" && line.commas[1] == "stamp_ns" &&
         line.commas[5] == "sensor";
}

std::int64_t whole(const Tokens& t, std::size_t at) {
  std::int64_t out = 0;
  const char* const end = t[at].data() + t[at].size();
  const auto [stop, error] = std::from_chars(t[at].data(), end, out);
  if (error != std::errc() || stop != end || t[at].empty())
    throw Malformed{"bad number",
                    fmt::format("field {} is '{}', no whole number", at + 1, printable(t[at].substr(0, 24)))};
  return out;
}

struct Columns {
  std::size_t step, stamp, x, y, yaw, sensor, range;
  std::optional<std::size_t> truth, beam, odom_x, odom_y, odom_yaw;
  std::size_t count;
};

Columns columns_of(const Tokens& head, const std::string& where) {
  const auto need = [&](const char* name) { return required_column(head, name, where); };
  Columns c{need("step"),         need("stamp_ns"),         need("x_m"),     need("y_m"),
            need("yaw_rad"),      need("sensor"),           need("range_m"), column(head, "truth"),
            column(head, "beam"), column(head, "odom_x_m"), std::nullopt,    std::nullopt,
            head.size()};
  if (c.odom_x) c.odom_y = need("odom_y_m"), c.odom_yaw = need("odom_yaw_rad");
  return c;
}

class CastReader {
 public:
  explicit CastReader(Log& log) : log_(log) {}

  void comment(std::string_view line, const std::string& where) {
    try {
      const auto sensor = parse_sensor_line(line, log_.sensors.size());
      if (!sensor) return log_.skip("#");
      if (const auto errors = check(sensor->sensor); !errors.empty())
        throw std::invalid_argument(errors.front().field + " " + errors.front().reason);
      if (log_.sensors.size() >= kMostSensors) throw std::invalid_argument("too many sensors");
      log_.sensors.push_back(*sensor);
    } catch (const std::invalid_argument& bad) {  // without its sensors no row can be used
      throw InputError(fmt::format("{}: {}", where, bad.what()));
    }
  }

  void head(const Tokens& t, const std::string& where) {
    columns_ = columns_of(t, where);
    if (log_.sensors.empty()) {
      throw InputError(where +
                       ": no line says '# sensor 0 ...' before the head line: write the readings with `evigrid cast "
                       "--sensors`");
    }
  }
  [[nodiscard]] bool has_head() const { return columns_.has_value(); }

  void row(const Tokens& t) {
    const Columns& c = *columns_;
    expect_fields(t.size(), c.count);
    const std::int64_t step = whole(t, c.step), stamp = whole(t, c.stamp), sensor = whole(t, c.sensor);
    if (stamp <= -kMostStamp_ns || stamp >= kMostStamp_ns) throw Malformed{"bad number", "the time stamp is no time"};
    const std::int64_t beam = c.beam ? whole(t, *c.beam) : 0;
    if (sensor < 0 || sensor >= static_cast<std::int64_t>(log_.sensors.size()))
      throw Malformed{"unknown sensor", fmt::format("sensor {} of {}", sensor, log_.sensors.size())};
    const Pose2 pose{number(t, c.odom_x.value_or(c.x)), number(t, c.odom_y.value_or(c.y)),
                     number(t, c.odom_yaw.value_or(c.yaw))};
    const float range = range_m(number(t, c.range), log_);
    const float truth = c.truth ? static_cast<float>(number(t, *c.truth)) : 0;
    const auto index = static_cast<std::size_t>(sensor);
    const bool new_scan = log_.scans.empty() || step != step_;
    const bool goes_on = !new_scan && beam > 0 && log_.readings.back().sensor == index &&
                         beam == static_cast<std::int64_t>(log_.readings.back().count);
    if (!goes_on && beam != 0) throw Malformed{"wrong beam", fmt::format("beam {} follows none before it", beam)};
    if (beam >= log_.sensors[index].sensor.beams)
      throw Malformed{"wrong beam", fmt::format("beam {} of {}", beam, log_.sensors[index].sensor.beams)};
    if (new_scan) {
      step_ = step;
      log_.scans.push_back({stamp, pose, log_.readings.size(), 0});
    }
    if (!goes_on) {
      log_.readings.push_back({index, log_.ranges_m.size(), 0});
      ++log_.scans.back().count;
    }
    ++log_.readings.back().count;
    log_.ranges_m.push_back(range);
    if (c.truth) log_.truth_m.push_back(truth);
  }

  void finish() {
    if (columns_ && columns_->odom_x) log_.poses = Poses::dead_reckoned;
  }

 private:
  Log& log_;
  std::optional<Columns> columns_;
  std::int64_t step_ = 0;
};

void read_cast(std::span<const Source> sources, Log& log) {
  LineReader lines(sources.front());
  CastReader reader(log);
  std::string_view line;
  Tokens tokens;
  const auto where = [&] { return fmt::format("{}:{}", sources.front().name, lines.line_number()); };
  while (lines.next(line)) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    if (line[first] == '#') {
      reader.comment(line, where());
      continue;
    }
    split_commas(line, tokens, kMostColumns);
    if (!reader.has_head()) {
      reader.head(tokens, where());
      continue;
    }
    try {
      reader.row(tokens);
    } catch (const Malformed& bad) {
      log.reject(sources.front().name, lines.line_number(), bad.reason, bad.detail);
    }
  }
  reader.finish();
}

}  // namespace

const Format kCast{"cast",          "CSV of `evigrid cast --sensors`: step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m,...",
                   looks_like_cast, nullptr,
                   nullptr,         1,
                   read_cast};

}  // namespace evigrid::driver
