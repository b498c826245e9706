// SPDX-License-Identifier: Apache-2.0
// The errors of each sensor over the true range as a picture: one panel a sensor, a dot an echo, the median of each bin
// as a line. Errors beyond the panel lie on its border in orange, so that none is hidden.
#pragma once
#include <vector>

#include "calibrate/statistics.hpp"
#include "picture/canvas.hpp"

namespace evigrid::driver {

Canvas draw_scatter(const std::vector<Calibration>& sensors, const CalibrationLimits& limits);

}  // namespace evigrid::driver
