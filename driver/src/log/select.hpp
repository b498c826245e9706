// SPDX-License-Identifier: Apache-2.0
// A part of a log: some of its scans, some kinds of its sensors. Both throw InputError naming the option.
#pragma once
#include <string>
#include <vector>

#include "log/log.hpp"

namespace evigrid::driver {

/// "N" keeps scan N alone, "A:B" the scans from A up to but not including B ("A:" and ":B" to an end); counted from 0.
void keep_scans(Log& log, const std::string& which);

/// Keeps the readings of sensors of these kinds ("sonar", "ir") or names ("front"); the others are dropped unread.
void keep_sensors(Log& log, const std::vector<std::string>& kinds);

}  // namespace evigrid::driver
