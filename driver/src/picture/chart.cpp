// SPDX-License-Identifier: Apache-2.0
#include "picture/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evigrid::driver {
namespace {

constexpr int kLeft_px = 92, kRight_px = 24, kTop_px = 92, kBottom_px = 64;
constexpr Rgb kGrid{224, 224, 224}, kLimit{213, 94, 0};

struct Axes {
  int left, top, width, height;
  double x_top, y_top;
  [[nodiscard]] double x(double v) const { return left + v / x_top * width; }
  [[nodiscard]] double y(double v) const { return top + height - v / y_top * height; }
};

/// 12000 → "12k": labels stay short.
std::string label_of(double v) {
  if (v >= 1e6) return fmt::format("{:g}M", v / 1e6);
  return v >= 1e4 ? fmt::format("{:g}k", v / 1e3) : fmt::format("{:g}", v);
}

double largest(const Chart& chart, std::vector<double> Series::*values) {
  double top = 0;
  for (const Series& s : chart.series)
    for (const double v : s.*values)
      if (std::isfinite(v)) top = std::max(top, v);
  return top;
}

void draw_axes(Canvas& canvas, const Axes& a, const Chart& chart, const std::vector<double>& xs,
               const std::vector<double>& ys) {
  for (const double v : ys) {
    const int y = static_cast<int>(a.y(v));
    canvas.rect(a.left, y, a.width, 1, kGrid);
    const std::string label = label_of(v);
    canvas.text(a.left - text_width(label, 2) - 6, y - 7, label, 2, kInk);
  }
  for (const double v : xs) {
    const int x = static_cast<int>(a.x(v));
    canvas.rect(x, a.top, 1, a.height, kGrid);
    const std::string label = label_of(v);
    canvas.text(x - text_width(label, 2) / 2, a.top + a.height + 8, label, 2, kInk);
  }
  canvas.rect(a.left, a.top, 1, a.height, kInk);
  canvas.rect(a.left, a.top + a.height, a.width, 1, kInk);
  canvas.text(a.left + a.width - text_width(chart.x_label, 2), a.top + a.height + 34, chart.x_label, 2, kInk);
  canvas.text(kMargin_px, a.top - 24, chart.y_label, 2, kInk);
}

}  // namespace

std::vector<double> round_ticks(double top, int most) {
  if (!(top > 0) || !std::isfinite(top)) top = 1;
  double step = std::pow(10, std::floor(std::log10(top / most)));
  for (const double by : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0}) {  // 1, 2, 5, 10, 20, 50, 100
    if (step * most >= top * (1 - 1e-9)) break;
    step *= by;
  }
  std::vector<double> ticks;
  for (int i = 0; i == 0 || ticks.back() < top * (1 - 1e-9); ++i) ticks.push_back(i * step);
  return ticks;
}

Canvas draw_chart(const Chart& chart, int width, int height) {
  Canvas canvas(width, height, kPaper);
  draw_head(canvas, chart.text);
  const std::vector<double> xs = round_ticks(largest(chart, &Series::x), 8),
                            ys = round_ticks(std::max(largest(chart, &Series::y), chart.limit.value_or(0)), 6);
  const Axes a{kLeft_px, kTop_px, width - kLeft_px - kRight_px, height - kTop_px - kBottom_px, xs.back(), ys.back()};
  draw_axes(canvas, a, chart, xs, ys);
  int legend_x = kLeft_px + text_width(chart.y_label, 2);
  if (chart.limit) {
    canvas.rect(a.left, static_cast<int>(a.y(*chart.limit)), a.width, 2, kLimit);
    legend_x = draw_swatch(canvas, legend_x, a.top - 24, kLimit, chart.limit_name);
  }
  for (const Series& s : chart.series) {
    legend_x = draw_swatch(canvas, legend_x, a.top - 24, s.colour, s.name);
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
      if (s.dots) canvas.disc(a.x(s.x[i]), a.y(s.y[i]), 4, s.colour);
      if (i > 0 && std::isfinite(s.y[i - 1]))
        canvas.line(a.x(s.x[i - 1]), a.y(s.y[i - 1]), a.x(s.x[i]), a.y(s.y[i]), s.width, s.colour);
    }
  }
  return canvas;
}

}  // namespace evigrid::driver
