// SPDX-License-Identifier: Apache-2.0
// Pixels; the errors shown reach twice the outlier limit either way. Colours: Okabe & Ito.
#include "calibrate/scatter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evigrid::driver {
namespace {

constexpr int kWidth = 1000, kPanel = 320, kLeft = 90, kRight = 20, kTop = 46, kBottom = 40, kText = 2;
constexpr Rgb kPaper{255, 255, 255}, kInk{40, 40, 40}, kGrid{215, 215, 215}, kDot{0, 114, 178}, kOutlier{213, 94, 0},
    kBeyond{230, 159, 0}, kMedian{0, 0, 0};

/// One panel's axes: metres to pixels.
struct Axes {
  int top = 0;
  double most_m = 1, error_m = 1;
  [[nodiscard]] double x(double truth_m) const { return kLeft + truth_m / most_m * (kWidth - kLeft - kRight); }
  [[nodiscard]] double y(double e_m) const { return top + kTop + (1 - e_m / error_m) / 2 * (kPanel - kTop - kBottom); }
};

void draw_axes(Canvas& canvas, const Axes& axes) {
  const double step_m = std::max(0.5, std::ceil(axes.most_m / 8 * 2) / 2);
  for (double r = 0; r <= axes.most_m + 1e-9; r += step_m) {
    canvas.line(axes.x(r), axes.y(axes.error_m), axes.x(r), axes.y(-axes.error_m), 1, kGrid);
    const std::string label = fmt::format("{:g}", r);
    canvas.text(static_cast<int>(axes.x(r)) - text_width(label, kText) / 2, static_cast<int>(axes.y(-axes.error_m)) + 8,
                label, kText, kInk);
  }
  for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const double e = part * axes.error_m;
    canvas.line(axes.x(0), axes.y(e), axes.x(axes.most_m), axes.y(e), 1, part == 0 ? kInk : kGrid);
    const std::string label = fmt::format("{:+.2g}", e);
    canvas.text(kLeft - 8 - text_width(label, kText), static_cast<int>(axes.y(e)) - 6, label, kText, kInk);
  }
}

void draw_panel(Canvas& canvas, const Axes& axes, const Calibration& c, const CalibrationLimits& limits) {
  canvas.text(kLeft, axes.top + 8,
              fmt::format("{}: error m over true range m; {} echoes, outliers {:.1f} %", c.sensor, c.all.echoes(),
                          100 * c.all.outlier_share()),
              kText, kInk);
  draw_axes(canvas, axes);
  for (const Sample& s : c.samples) {
    const double error_m = s.reading_m - s.truth_m;
    const bool outlier = std::abs(error_m) > limits.outlier_m, beyond = std::abs(error_m) > axes.error_m;
    canvas.disc(axes.x(s.truth_m), axes.y(std::clamp(error_m, -axes.error_m, axes.error_m)), 1.5,
                beyond    ? kBeyond
                : outlier ? kOutlier
                          : kDot);
  }
  const RangeBin* last = nullptr;
  for (const RangeBin& bin : c.bins) {
    if (bin.stats.echoes() == 0) continue;
    const auto middle = [](const RangeBin& b) { return (b.from_m + b.to_m) / 2; };
    const auto height = [&](const RangeBin& b) {
      return axes.y(std::clamp(b.stats.bias_m, -axes.error_m, axes.error_m));
    };
    if (last != nullptr)
      canvas.line(axes.x(middle(*last)), height(*last), axes.x(middle(bin)), height(bin), 2, kMedian);
    last = &bin;
  }
}

}  // namespace

Canvas draw_scatter(const std::vector<Calibration>& sensors, const CalibrationLimits& limits) {
  double most_m = limits.bin_m;
  for (const Calibration& c : sensors) {
    if (!c.bins.empty()) most_m = std::max(most_m, c.bins.back().to_m);
  }
  Canvas canvas(kWidth, kPanel * std::max<int>(1, static_cast<int>(sensors.size())), kPaper);
  int top = 0;
  for (const Calibration& c : sensors) {
    draw_panel(canvas, {top, most_m, 2 * limits.outlier_m}, c, limits);
    top += kPanel;
  }
  return canvas;
}

}  // namespace evigrid::driver
