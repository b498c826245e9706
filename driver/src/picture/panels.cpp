// SPDX-License-Identifier: Apache-2.0
// Four small maps of one size, in a row or two by two, whichever is nearer to the shape of a screen.
#include <algorithm>
#include <array>
#include <cmath>

#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

constexpr int kPanel_px = 480, kGap_px = 16, kCaption_px = 26, kBarRoom_px = 40;
constexpr std::array<std::string_view, 4> kCaptions{"m(empty)", "m(occupied)", "m(unknown)", "grey composite"};

}  // namespace

Canvas draw_panels(const Layers& layers, const std::vector<Pose2>& path, const PictureText& text,
                   const PictureOptions& options) {
  const CellRect& r = layers.rect;
  const int scale =
      options.scale > 0
          ? options.scale
          : static_cast<int>(std::max<std::int64_t>(1, kPanel_px / std::max({r.width, r.height, std::int64_t{1}})));
  const std::int64_t w = std::max<std::int64_t>(r.width * scale, 200), h = r.height * scale;
  const int columns = 2 * w > 3 * h ? 2 : 4, rows = 4 / columns;
  const std::int64_t width = columns * (w + kGap_px) - kGap_px + 2 * kMargin_px;
  const std::int64_t height = kHead_px + rows * (h + kCaption_px + kGap_px) + kBarRoom_px + kMargin_px;
  Canvas canvas = canvas_within(width, height, options);
  draw_head(canvas, text);
  for (int panel = 0; panel < 4; ++panel) {
    const int x = kMargin_px + panel % columns * static_cast<int>(w + kGap_px);
    const int y = kHead_px + panel / columns * static_cast<int>(h + kCaption_px + kGap_px);
    canvas.text(x, y + 4, kCaptions[static_cast<std::size_t>(panel)], 2, kInk);
    const MapFrame frame{x, y + kCaption_px, scale, r, layers.cell_m};
    canvas.rect(frame.left - 1, frame.top - 1, frame.width_px() + 2, frame.height_px() + 2, kInk);
    const float* mass[] = {layers.e(), layers.o(), layers.u()};
    draw_cells(canvas, frame, [&](std::size_t i) {
      return panel < 3 ? colour_of(Ramp::greys, mass[panel][i])
                       : composite_grey(layers.e()[i], layers.o()[i], layers.u()[i]);
    });
    draw_path(canvas, frame, path);
  }
  const int foot = static_cast<int>(height) - kBarRoom_px;
  canvas.text(kMargin_px, foot, "mass:", 2, kInk);
  int at = kMargin_px + text_width("mass:", 2) + 12;
  for (const auto& [grey, label] : {std::pair{0.0, "0"}, {0.5, "0.5"}, {1.0, "1"}})
    at = draw_swatch(canvas, at, foot, colour_of(Ramp::greys, grey), label);
  at += 20;
  canvas.text(at, foot, "composite:", 2, kInk);
  at += text_width("composite:", 2) + 12;
  for (const auto& [colour, label] : {std::pair{composite_grey(1, 0, 0), "empty"},
                                      {composite_grey(0, 0, 1), "unknown"},
                                      {composite_grey(0, 1, 0), "occupied"}})
    at = draw_swatch(canvas, at, foot, colour, label);
  draw_scale_bar(canvas, canvas.width() - kMargin_px, foot, scale / layers.cell_m);
  return canvas;
}

}  // namespace evigrid::driver
