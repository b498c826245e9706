// SPDX-License-Identifier: Apache-2.0
#include "log/select.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "error.hpp"

namespace evigrid::driver {
namespace {

std::size_t whole(std::string_view text, std::size_t when_empty, const std::string& all) {
  if (text.empty()) return when_empty;
  std::size_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) {
    throw InputError(fmt::format("--scans: '{}' is neither N nor A:B", all));
  }
  return value;
}

}  // namespace

void keep_scans(Log& log, const std::string& which) {
  const std::size_t colon = which.find(':'), n = log.scans.size();
  const std::string_view text = which;
  std::size_t from = 0, to = 0;
  if (colon == std::string::npos) {
    from = whole(text, n, which);
    to = from < n ? from + 1 : from;
  } else {
    from = whole(text.substr(0, colon), 0, which);
    to = whole(text.substr(colon + 1), n, which);
  }
  if (from >= n || to > n || from >= to) {
    throw InputError(fmt::format("--scans: '{}' is no part of 0:{}, the scans of this log", which, n));
  }
  log.scans = {log.scans.begin() + static_cast<std::ptrdiff_t>(from),
               log.scans.begin() + static_cast<std::ptrdiff_t>(to)};
}

void keep_sensors(Log& log, const std::vector<std::string>& kinds) {
  std::vector<bool> keep(log.sensors.size(), false);
  std::set<std::string> known;
  for (const LogSensor& s : log.sensors) known.insert({s.kind, s.name.empty() ? s.kind : s.name});
  for (const std::string& kind : kinds) {
    bool found = false;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (log.sensors[i].kind != kind && log.sensors[i].name != kind) continue;
      keep[i] = found = true;
    }
    if (!found) {
      std::string names;
      for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
      throw InputError(fmt::format("--sensors: this log has no '{}'; it has: {}", kind, names));
    }
  }
  std::vector<LogReading> readings;
  for (LogScan& scan : log.scans) {
    const std::size_t first = readings.size();
    for (std::size_t i = scan.first; i < scan.first + scan.count; ++i) {
      if (keep[log.readings[i].sensor]) readings.push_back(log.readings[i]);
    }
    scan.first = first;
    scan.count = readings.size() - first;
  }
  log.readings = std::move(readings);
}

}  // namespace evigrid::driver
