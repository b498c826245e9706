// SPDX-License-Identifier: Apache-2.0
#include "paper/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "paper/page.hpp"

namespace evigrid::driver {
namespace {

constexpr double kWidth = 640, kHeight = 360, kLeft = 64, kRight = 16, kTop = 34, kBottom = 46;
constexpr std::array<const char*, 6> kColours{"#1f4e9c", "#c2571a", "#2a7f4f", "#7a3fa0", "#a1323a", "#5a6675"};

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double v) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  void settle() {  // never empty, never of no width
    if (!(low <= high)) low = 0, high = 1;
    if (low == high) low -= 0.5, high += 0.5;
  }
};

}  // namespace

std::vector<double> ticks(double low, double high, int wanted) {
  const double rough = (high - low) / std::max(wanted, 1), power = std::pow(10, std::floor(std::log10(rough)));
  const double digit = rough / power;
  const double step = power * (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10);
  std::vector<double> out;
  for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) out.push_back(n * step + 0.0);
  return out;
}

std::string svg_plot(const PlotText& text, const std::vector<PlotSeries>& series, bool zero) {
  Range x, y;
  for (const PlotSeries& s : series) {
    for (const auto& [px, py] : s.points) {
      if (std::isfinite(px) && std::isfinite(py)) x.add(px), y.add(py);
    }
  }
  if (zero) y.add(0);
  x.settle(), y.settle();
  y.high += 0.05 * (y.high - y.low);
  const auto at_x = [&](double v) { return kLeft + (v - x.low) / (x.high - x.low) * (kWidth - kLeft - kRight); };
  const auto at_y = [&](double v) {
    return kHeight - kBottom - (v - y.low) / (y.high - y.low) * (kHeight - kTop - kBottom);
  };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" font-family=\"sans-serif\" "
      "font-size=\"12\"><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/><text x=\"{}\" y=\"18\" "
      "font-weight=\"600\">{}</text>",
      kWidth, kHeight, kWidth, kLeft, escaped(text.title));
  for (const double v : ticks(y.low, y.high, 5)) {
    svg += fmt::format(
        "<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#e3e7ec\"/><text x=\"{}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{:g}</text>",
        kLeft, kWidth - kRight, at_y(v), at_y(v), kLeft - 6, at_y(v) + 4, v);
  }
  for (const double v : ticks(x.low, x.high, 8)) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:g}</text>", at_x(v),
                       kHeight - kBottom + 16, v);
  }
  svg += fmt::format(
      "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2}\" y2=\"{2}\" stroke=\"#1c2430\"/><text x=\"{3}\" y=\"{4}\" "
      "text-anchor=\"middle\">{5}</text><text transform=\"translate(14 {6}) rotate(-90)\" "
      "text-anchor=\"middle\">{7}</text>",
      kLeft, kWidth - kRight, kHeight - kBottom, (kLeft + kWidth - kRight) / 2, kHeight - 8, escaped(text.x),
      (kTop + kHeight - kBottom) / 2, escaped(text.y));
  double legend_x = kLeft + 8;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const PlotSeries& s = series[i];
    const char* colour = kColours[i % kColours.size()];
    std::string way;
    bool pen_up = true;
    for (const auto& [px, py] : s.points) {
      if (!std::isfinite(px) || !std::isfinite(py)) {
        pen_up = true;
        continue;
      }
      if (s.line) {
        way += fmt::format("{}{:.1f} {:.1f}", pen_up ? "M" : "L", at_x(px), at_y(py));
        pen_up = false;
      } else {
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>", at_x(px), at_y(py), colour);
      }
    }
    if (!way.empty())
      svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>", way, colour);
    if (s.name.empty()) continue;
    svg += fmt::format(
        "<rect x=\"{:.0f}\" y=\"{}\" width=\"10\" height=\"10\" fill=\"{}\"/><text x=\"{:.0f}\" y=\"{}\">{}</text>",
        legend_x, kTop - 8, colour, legend_x + 14, kTop + 1, escaped(s.name));
    legend_x += 30 + 7.0 * static_cast<double>(s.name.size());
  }
  return svg + "</svg>";
}

}  // namespace evigrid::driver
