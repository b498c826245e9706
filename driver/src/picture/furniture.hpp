// SPDX-License-Identifier: Apache-2.0
// What every picture of a map shares: where its cells lie on the canvas, the robot's path, the scale bar, swatches and
// the colour bar.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/types.hpp"
#include "out/layers.hpp"
#include "picture/canvas.hpp"

namespace evigrid::driver {

inline constexpr Rgb kInk{34, 34, 34}, kPaper{255, 255, 255};
inline constexpr Rgb kPath{0, 114, 178}, kStart{0, 158, 115}, kEnd{213, 94, 0};  // Okabe & Ito
inline constexpr int kMargin_px = 16, kHead_px = 52, kLine_px = 28;              // kLine: a row of text at scale 2

struct PictureText {
  std::string title;     ///< first line
  std::string subtitle;  ///< second line, smaller
};

/// From frame M to pixels: the upper left corner of the cells and how many pixels a cell's side has.
struct MapFrame {
  int left = 0, top = 0, scale = 1;
  CellRect rect{};
  double cell_m = 0;
  [[nodiscard]] int width_px() const { return static_cast<int>(rect.width) * scale; }
  [[nodiscard]] int height_px() const { return static_cast<int>(rect.height) * scale; }
  [[nodiscard]] double x(double x_m) const { return left + (x_m / cell_m - static_cast<double>(rect.x)) * scale; }
  [[nodiscard]] double y(double y_m) const {
    return top + (static_cast<double>(rect.y + rect.height) - y_m / cell_m) * scale;
  }
};

/// Pixels a cell so that the longer side has at least `side_px`; 1 when it has more cells than that.
int scale_for(const CellRect& rect, int side_px);

void draw_head(Canvas&, const PictureText&);
/// One colour a cell, the largest y on top.
void draw_cells(Canvas&, const MapFrame&, const std::function<Rgb(std::size_t)>& colour);
/// A line, a ring at its end and a disc at its start: both are seen where they meet.
void draw_path(Canvas&, const MapFrame&, const std::vector<Pose2>& path);
/// "path", "start", "end" with their signs; returns where the row ends.
int draw_path_legend(Canvas&, int x, int y);
/// A box of the colour and its name; returns where the next one may start.
int draw_swatch(Canvas&, int x, int y, Rgb colour, std::string_view label);
/// Right-aligned: a round number of metres, as long as it is in the map.
void draw_scale_bar(Canvas&, int right, int y, double px_per_m);
/// Upright, `height` tall, low end below; ticks at fifths or so of [0, top]. Returns its width with the numbers.
int draw_colour_bar(Canvas&, int x, int y, int height, double top, bool more_above,
                    const std::function<Rgb(double)>& colour);
/// Room that the numbers of draw_colour_bar need beside the bar.
inline constexpr int kColourBar_px = 100;

}  // namespace evigrid::driver
