// SPDX-License-Identifier: Apache-2.0
// Log records of our own making: a robot in the middle of a round room.
#pragma once
#include <fmt/format.h>

#include <string>

namespace evigrid::driver {

/// "FLASER n <ranges> x y theta odom ipc_time host logger_time"
inline std::string flaser(int n, const std::string& range, double t_s, const std::string& pose = "1 2 0.5",
                          const std::string& keyword = "FLASER") {
  std::string out = fmt::format("{} {}", keyword, n);
  for (int i = 0; i < n; ++i) out.append(" ").append(range);
  return out + fmt::format(" {} 0 0 0 {} host {}\n", pose, t_s, t_s);
}

/// The same with one beam of its own value.
inline std::string flaser_with(int n, int beam, const std::string& odd, double t_s) {
  std::string out = fmt::format("FLASER {}", n);
  for (int i = 0; i < n; ++i) out.append(" ").append(i == beam ? odd : "3.5");
  return out + fmt::format(" 0 0 0 0 0 0 {} host {}\n", t_s, t_s);
}

inline std::string robotlaser(int n, double start_rad, double step_rad, double first_m, double t_s,
                              int remissions = 0) {
  std::string out = fmt::format("ROBOTLASER1 0 {} 3.14 {} 50 0.01 {} {}", start_rad, step_rad, remissions > 0, n);
  for (int i = 0; i < n; ++i) out += fmt::format(" {}", first_m + i);
  out += fmt::format(" {}", remissions);
  for (int i = 0; i < remissions; ++i) out += " 7";
  return out + fmt::format(" 4 5 0.25 9 9 9 0 0 0 0 0 {} host {}\n", t_s, t_s);
}

}  // namespace evigrid::driver
