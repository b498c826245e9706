// SPDX-License-Identifier: Apache-2.0
// Small maps are enlarged by a whole factor, so that cells stay squares; large ones keep one pixel a cell.
#include "picture/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evigrid::driver {
namespace {

constexpr Rgb kUnknown{158, 158, 158}, kEmpty{250, 250, 247}, kOccupied{14, 22, 56}, kConflict{230, 159, 0};
constexpr Rgb kPath{0, 114, 178}, kStart{0, 158, 115}, kEnd{213, 94, 0}, kInk{34, 34, 34}, kPaper{255, 255, 255};
constexpr int kLongSide_px = 900;    // at least, on screen
constexpr int kLeastWidth_px = 780;  // for title and legend
constexpr int kMargin_px = 16, kHead_px = 52, kFoot_px = 64;

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

std::uint8_t mix(float e, float o, float u, float c, std::uint8_t Rgb::*part) {
  const float calm = e * kEmpty.*part + o * kOccupied.*part + u * kUnknown.*part;
  return static_cast<std::uint8_t>(std::clamp(std::lround((1 - c) * calm + c * kConflict.*part), 0L, 255L));
}

struct Frame {  // from frame M to pixels
  int left, top, scale;
  const Layers& layers;
  [[nodiscard]] double x(double x_m) const {
    return left + (x_m / layers.cell_m - static_cast<double>(layers.rect.x)) * scale;
  }
  [[nodiscard]] double y(double y_m) const {
    return top + (static_cast<double>(layers.rect.y + layers.rect.height) - y_m / layers.cell_m) * scale;
  }
};

void draw_cells(Canvas& canvas, const Frame& f) {
  const Layers& l = f.layers;
  for (std::int64_t y = 0; y < l.rect.height; ++y) {
    for (std::int64_t x = 0; x < l.rect.width; ++x) {
      const auto i = static_cast<std::size_t>(y * l.rect.width + x);
      canvas.rect(f.left + static_cast<int>(x) * f.scale, f.top + static_cast<int>(l.rect.height - 1 - y) * f.scale,
                  f.scale, f.scale, cell_colour(l.e()[i], l.o()[i], l.u()[i], l.conflict()[i]));
    }
  }
}

void draw_path(Canvas& canvas, const Frame& f, const std::vector<Pose2>& path) {
  if (path.empty()) return;
  for (std::size_t i = 1; i < path.size(); ++i) {
    canvas.line(f.x(path[i - 1].x_m), f.y(path[i - 1].y_m), f.x(path[i].x_m), f.y(path[i].y_m), 1, kPath);
  }
  for (const auto& [pose, colour] : {std::pair{path.back(), kEnd}, std::pair{path.front(), kStart}}) {
    canvas.disc(f.x(pose.x_m), f.y(pose.y_m), 6, kPaper);
    canvas.disc(f.x(pose.x_m), f.y(pose.y_m), 4.5, colour);
  }
}

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

void draw_foot(Canvas& canvas, const Frame& f, int y, bool with_path) {
  int x = kMargin_px;
  for (const auto& [colour, label] :
       {std::pair{kEmpty, "empty"}, {kOccupied, "occupied"}, {kUnknown, "unknown"}, {kConflict, "conflict"}}) {
    canvas.rect(x, y, 18, 14, kInk);
    canvas.rect(x + 1, y + 1, 16, 12, colour);
    canvas.text(x + 24, y, label, 2, kInk);
    x += 24 + text_width(label, 2) + 14;
  }
  if (with_path) {
    int px = kMargin_px;
    const int py = y + 28;
    canvas.rect(px, py + 6, 18, 2, kPath);
    canvas.text(px + 24, py, "path", 2, kInk);
    px += 24 + text_width("path", 2) + 14;
    for (const auto& [colour, label] : {std::pair{kStart, "start"}, {kEnd, "end"}}) {
      canvas.disc(px + 8, py + 7, 5, colour);
      canvas.text(px + 24, py, label, 2, kInk);
      px += 24 + text_width(label, 2) + 14;
    }
  }
  const double px_per_m = f.scale / f.layers.cell_m;
  const double bar_m = bar_length_m(px_per_m, std::min(0.25 * canvas.width(), 240.0));
  const int bar_px = std::max(2, static_cast<int>(std::lround(bar_m * px_per_m)));
  const int right = canvas.width() - kMargin_px, bar_y = y + 28;
  canvas.rect(right - bar_px, bar_y + 6, bar_px, 3, kInk);
  canvas.rect(right - bar_px, bar_y, 2, 14, kInk);
  canvas.rect(right - 2, bar_y, 2, 14, kInk);
  const std::string label = fmt::format("{:g} m", bar_m);
  canvas.text(right - bar_px - text_width(label, 2) - 8, bar_y, label, 2, kInk);
}

}  // namespace

// Conflict is shown where it still matters: a cell that both sides claim, min(e, o) high. The running sum of k alone
// would paint every wall that hundreds of beams graze, although the masses there have long been settled; it only
// decides how soon an ambivalent cell turns orange.
Rgb cell_colour(float e, float o, float u, float conflict) noexcept {
  const float ambivalence = std::min(e, o);
  const float heard = smooth_step(0.05F, 0.5F, conflict);
  const float c = smooth_step(0.15F, 0.35F, ambivalence) * heard;
  return {mix(e, o, u, c, &Rgb::r), mix(e, o, u, c, &Rgb::g), mix(e, o, u, c, &Rgb::b)};
}

Canvas draw_map(const Layers& layers, const std::vector<Pose2>& trajectory, const PictureText& text) {
  const auto w = static_cast<int>(layers.rect.width), h = static_cast<int>(layers.rect.height);
  const int longest = std::max({w, h, 1});
  const int scale = longest >= kLongSide_px ? 1 : (kLongSide_px + longest - 1) / longest;
  const int width = std::max(w * scale, kLeastWidth_px) + 2 * kMargin_px;
  Canvas canvas(width, h * scale + kHead_px + kFoot_px + kMargin_px, kPaper);
  const Frame frame{(width - w * scale) / 2, kHead_px, scale, layers};
  canvas.text(kMargin_px, 12, text.title, 2, kInk);
  canvas.text(kMargin_px, 34, text.subtitle, 1, kInk);
  draw_cells(canvas, frame);
  draw_path(canvas, frame, trajectory);
  draw_foot(canvas, frame, kHead_px + h * scale + kMargin_px, !trajectory.empty());
  return canvas;
}

}  // namespace evigrid::driver
