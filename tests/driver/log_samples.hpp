// SPDX-License-Identifier: Apache-2.0
// Three good records of every format, of our own making, and what can be done to them.
#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "records.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {

struct FormatSample {
  std::string format;
  std::vector<std::pair<std::string, std::string>> beside;  ///< other files of the log: name, text
  std::string file;                                         ///< the file that the tests damage
  std::string head;                                         ///< its head line, or nothing
  std::vector<std::string> rows;                            ///< one scan each, without line end
  char separator = ' ';
  std::size_t range_at = 0;  ///< the field that holds a range
  bool timed = true;         ///< the records hold a time

  [[nodiscard]] std::string text() const {
    std::string out = head.empty() ? "" : head + "\n";
    for (const std::string& row : rows) out += row + "\n";
    return out;
  }
  /// Writes all files into the folder; the answer names the damaged one.
  [[nodiscard]] std::string write(const TempDir& dir, const std::string& bytes) const {
    for (const auto& [name, other] : beside) dir.write(name, other);
    return dir.write(file, bytes);
  }
};

inline void PrintTo(const FormatSample& sample, std::ostream* out) { *out << sample.format; }

inline std::string wean_scan(const std::string& range_cm, double t_s, const std::string& robot = "100 200 0",
                             const std::string& laser = "125 200 0") {
  return fmt::format("L {} {}", robot, laser) + [&] {
    std::string out;
    for (int i = 0; i < 180; ++i) out += " " + range_cm;
    return out;
  }() + fmt::format(" {}", t_s);
}

inline std::string lego_scan(int range_mm, int t_ms) {
  std::string out = fmt::format("S {} 660", t_ms);
  for (int i = 0; i < 660; ++i) out += fmt::format(" {}", range_mm + i % 5);
  return out;
}

inline std::string lego_motors(int t_ms, int left, int right) {
  return fmt::format("M {} {} {} 3000 0 {} {} 3000 0 0 0 6000 0\n", t_ms, left, left, right, right);
}

inline std::string trimmed_end(std::string line) {
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line;
}

inline std::string numbered(const std::string& stem, int from, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += fmt::format("{}{}{}", i > 0 ? "," : "", stem, from + i);
  return out;
}

inline std::string repeated(const std::string& value, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += (i > 0 ? "," : "") + value;
  return out;
}

inline std::vector<FormatSample> format_samples() {
  std::vector<FormatSample> all;
  all.push_back({"carmen", {}, "a.log", "", {}, ' ', 10});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(trimmed_end(flaser(180, "3.5", i)));
  all.push_back(
      {"ring8", {{"poses.txt", "1000 0 0 0\n1001 10 0 0\n1002 20 0 0\n"}}, "measurement.txt", "", {}, ' ', 4});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(fmt::format("{} 900 900 900 900 900 900 900 900", 1000 + i));
  all.push_back({"wean", {}, "w.log", "", {}, ' ', 20});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(wean_scan("300", i));
  all.push_back(
      {"lego",
       {{"r_motors.txt", lego_motors(0, 100, 100) + lego_motors(1000, 200, 200) + lego_motors(2000, 300, 300)}},
       "r_scan.txt",
       "",
       {},
       ' ',
       20});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(lego_scan(1000, 500 * i));
  all.push_back({"bigwheelbot", {}, "b.txt", "", {}, ',', 3, false});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(fmt::format("10,12,{},120,80,60,30,469,496", 10 * i));
  all.push_back(
      {"roomba12", {}, "r.csv", "x,y,heading_angle_degrees," + numbered("sensor_", 0, 12), {}, ',', 5, false});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(fmt::format("4.0,{},90.0,", i) + repeated("1.5", 12));
  all.push_back({"uci24", {}, "u.data", numbered("S", 1, 24) + ",OUTPUT", {}, ',', 5, false});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(repeated("1.25", 24) + ",Move-Forward");
  all.push_back({"enmt482",
                 {},
                 "e.csv",
                 ",time,range,velocity_command,raw_ir1,raw_ir2,raw_ir3,raw_ir4,sonar1,sonar2",
                 {},
                 ',',
                 8});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(fmt::format("{},{}.5,1.0,0.1,1,1,3,2,1.01,0.99", i, i));
  all.push_back({"cast",
                 {},
                 "c.csv",
                 "# sensor 0 kind=sonar model=li2014 x_m=0.2 aperture_rad=0.3\n"
                 "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m",
                 {},
                 ',',
                 6});
  for (int i = 0; i < 3; ++i) all.back().rows.push_back(fmt::format("{},{}000000000,1,{},0.5,0,1.5", i, i, i));
  return all;
}

inline std::vector<std::string> fields_of(const std::string& row, char separator) {
  std::vector<std::string> out(1);
  for (const char c : row) {
    if (c == separator) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

inline std::string joined(const std::vector<std::string>& fields, char separator) {
  return fmt::format("{}", fmt::join(fields, std::string(1, separator)));
}

/// The row with one field replaced.
inline std::string with_field(const std::string& row, char separator, std::size_t at, const std::string& value) {
  auto fields = fields_of(row, separator);
  fields.at(at) = value;
  return joined(fields, separator);
}

/// The row cut off in the middle.
inline std::string first_half(const std::string& row, char separator) {
  auto fields = fields_of(row, separator);
  fields.resize(fields.size() / 2);
  return joined(fields, separator);
}

}  // namespace evigrid::driver
