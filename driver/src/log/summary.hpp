// SPDX-License-Identifier: Apache-2.0
// What a log holds, sensor by sensor, for `evigrid log` and for the report of a map.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "log/log.hpp"

namespace evigrid::driver {

/// Where poses and stamps come from and what the reader measured: merged into report.json by `map`.
nlohmann::ordered_json log_origin(const Log& log);

/// Everything that `evigrid log` tells, with units in the names.
nlohmann::ordered_json summarise(const Log& log);

/// The same for people.
std::string summary_text(const nlohmann::ordered_json& summary);

}  // namespace evigrid::driver
