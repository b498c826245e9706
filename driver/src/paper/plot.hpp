// SPDX-License-Identifier: Apache-2.0
// Line and point plots as SVG, for reports.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace evigrid::driver {

struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< values that are not finite leave a gap
  bool line = true;                               ///< else points alone
};

struct PlotText {
  std::string title, x, y;
};

/// 640 × 360 units, axes through the smallest box of all points with round steps; `zero`: the y axis begins at 0.
[[nodiscard]] std::string svg_plot(const PlotText& text, const std::vector<PlotSeries>& series, bool zero = true);

/// Round tick values within [low, high], about `wanted` of them.
[[nodiscard]] std::vector<double> ticks(double low, double high, int wanted);

}  // namespace evigrid::driver
