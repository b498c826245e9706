// SPDX-License-Identifier: Apache-2.0
// A line chart: numbers against a number, both axes from round number to round number, with a legend and, where there
// is a limit, a line for it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "picture/canvas.hpp"
#include "picture/furniture.hpp"

namespace evigrid::driver {

struct Series {
  std::string name;
  Rgb colour{};
  std::vector<double> x, y;  ///< of one length; what is not finite is left out
  int width = 2;
  bool dots = false;  ///< marks every point
};

struct Chart {
  PictureText text;
  std::string x_label, y_label;
  std::vector<Series> series;
  std::optional<double> limit{};  ///< drawn across, on the y axis
  std::string limit_name{};
};

[[nodiscard]] Canvas draw_chart(const Chart& chart, int width = 960, int height = 560);

/// Round numbers 1, 2, 5 · 10^k apart that cover [0, top]: the first is 0, the last is not below top. At most `most`
/// + 1.
[[nodiscard]] std::vector<double> round_ticks(double top, int most);

}  // namespace evigrid::driver
