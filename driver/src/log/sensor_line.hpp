// SPDX-License-Identifier: Apache-2.0
// A sensor in one comment line of a table of readings, so that the table says itself what measured:
//   # sensor 0 kind=sonar model=li2014 x_m=0.2 y_m=0 yaw_rad=0 aperture_rad=0.26 ... rho_e=0.35 ...
// Numbers are the shortest decimals that give back the same bits; a key that is missing keeps its default.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "log/log.hpp"

namespace evigrid::driver {

std::string sensor_line(std::size_t index, const LogSensor& sensor);

/// nullopt for a comment of another kind. Throws std::invalid_argument naming the key that is unknown, twice there or
/// bad, or saying that sensors are not numbered 0, 1, 2 … in their order.
std::optional<LogSensor> parse_sensor_line(std::string_view line, std::size_t expected_index);

}  // namespace evigrid::driver
