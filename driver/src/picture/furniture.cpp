// SPDX-License-Identifier: Apache-2.0
#include "picture/furniture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evigrid::driver {
namespace {

/// The longest 1, 2 or 5 · 10^k metres that take at most `room_px`.
double bar_length_m(double px_per_m, double room_px) {
  double best_m = 0.001;
  for (double decade = 0.001; decade < 1e7; decade *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step * decade * px_per_m <= room_px) best_m = std::max(best_m, step * decade);
    }
  }
  return best_m;
}

}  // namespace

int scale_for(const CellRect& rect, int side_px) {
  const std::int64_t longest = std::max({rect.width, rect.height, std::int64_t{1}});
  return longest >= side_px ? 1 : static_cast<int>((side_px + longest - 1) / longest);
}

void draw_head(Canvas& canvas, const PictureText& text) {
  const bool fits = kMargin_px + text_width(text.title, 2) <= canvas.width();
  canvas.text(kMargin_px, fits ? 12 : 16, text.title, fits ? 2 : 1, kInk);
  canvas.text(kMargin_px, 36, text.subtitle, 1, kInk);
}

void draw_cells(Canvas& canvas, const MapFrame& f, const std::function<Rgb(std::size_t)>& colour) {
  for (std::int64_t y = 0; y < f.rect.height; ++y) {
    for (std::int64_t x = 0; x < f.rect.width; ++x) {
      canvas.rect(f.left + static_cast<int>(x) * f.scale, f.top + static_cast<int>(f.rect.height - 1 - y) * f.scale,
                  f.scale, f.scale, colour(static_cast<std::size_t>(y * f.rect.width + x)));
    }
  }
}

void draw_path(Canvas& canvas, const MapFrame& f, const std::vector<Pose2>& path) {
  if (path.empty()) return;
  for (const auto& [thickness, colour] : {std::pair{3, kPaper}, {1, kPath}}) {  // the edge shows it on dark cells
    for (std::size_t i = 1; i < path.size(); ++i)
      canvas.line(f.x(path[i - 1].x_m), f.y(path[i - 1].y_m), f.x(path[i].x_m), f.y(path[i].y_m), thickness, colour);
  }
  const double ex = f.x(path.back().x_m), ey = f.y(path.back().y_m);
  canvas.ring(ex, ey, 11, 6, kPaper);
  canvas.ring(ex, ey, 9.5, 3, kEnd);
  const double sx = f.x(path.front().x_m), sy = f.y(path.front().y_m);
  canvas.disc(sx, sy, 6, kPaper);
  canvas.disc(sx, sy, 4.5, kStart);
}

int draw_swatch(Canvas& canvas, int x, int y, Rgb colour, std::string_view label) {
  canvas.rect(x, y, 18, 14, kInk);
  canvas.rect(x + 1, y + 1, 16, 12, colour);
  canvas.text(x + 24, y, label, 2, kInk);
  return x + 24 + text_width(label, 2) + 14;
}

int draw_path_legend(Canvas& canvas, int x, int y) {
  const auto label = [&](std::string_view text) {
    canvas.text(x + 24, y, text, 2, kInk);
    x += 24 + text_width(text, 2) + 14;
  };
  canvas.rect(x, y + 6, 18, 2, kPath);
  label("path");
  canvas.disc(x + 9, y + 7, 5, kStart);
  label("start");
  canvas.ring(x + 9, y + 7, 8, 3, kEnd);
  label("end");
  return x;
}

void draw_scale_bar(Canvas& canvas, int right, int y, double px_per_m) {
  const double bar_m = bar_length_m(px_per_m, std::min(0.25 * canvas.width(), 240.0));
  const int bar_px = std::max(2, static_cast<int>(std::lround(bar_m * px_per_m)));
  canvas.rect(right - bar_px, y + 6, bar_px, 3, kInk);
  canvas.rect(right - bar_px, y, 2, 14, kInk);
  canvas.rect(right - 2, y, 2, 14, kInk);
  const std::string label = fmt::format("{:g} m", bar_m);
  canvas.text(right - bar_px - text_width(label, 2) - 8, y, label, 2, kInk);
}

int draw_colour_bar(Canvas& canvas, int x, int y, int height, double top, bool more_above,
                    const std::function<Rgb(double)>& colour) {
  constexpr int kBar_px = 22, kTicks = 4;
  canvas.rect(x - 1, y - 1, kBar_px + 2, height + 2, kInk);
  for (int row = 0; row < height; ++row)
    canvas.rect(x, y + height - 1 - row, kBar_px, 1, colour(top * (row + 0.5) / height));
  for (int i = 0; i <= kTicks; ++i) {
    const int at = y + height - 1 - (height - 1) * i / kTicks;
    canvas.rect(x + kBar_px, at, 5, 1, kInk);
    const std::string label = fmt::format("{}{:.4g}", i == kTicks && more_above ? ">=" : "", top * i / kTicks);
    canvas.text(x + kBar_px + 9, std::clamp(at - 7, y - 4, y + height - 11), label, 2, kInk);
  }
  return kColourBar_px;
}

}  // namespace evigrid::driver
