// SPDX-License-Identifier: Apache-2.0
#include "paper/asharif2001_maps.hpp"
#include "picture/furniture.hpp"
#include "picture/ramp.hpp"

namespace evigrid::driver::asharif2001 {

Canvas draw_map_of(const Planned& map, const Room& room, bool ways) {
  constexpr std::array<Rgb, 8> kColours{{{0, 114, 178},
                                         {230, 120, 0},
                                         {0, 158, 115},
                                         {204, 60, 140},
                                         {86, 160, 233},
                                         {160, 130, 0},
                                         {120, 60, 180},
                                         {200, 40, 40}}};
  constexpr Rgb kTrue{214, 60, 50};
  constexpr int kKey_px = 30;
  const int scale = scale_for(room.rect, 560);
  const MapFrame frame{kMargin_px, kHead_px, scale, room.rect, map.layers.cell_m};
  Canvas canvas(std::max(frame.width_px(), 460) + 2 * kMargin_px, frame.height_px() + kHead_px + kKey_px + kMargin_px,
                kPaper);
  draw_head(canvas, {map.name + (ways ? ": ways" : ": map"),
                     ways ? "black: m = 1   red: true surfaces" : "black: m = 1, white: m = 0"});
  draw_cells(canvas, frame, [&](std::size_t i) {
    const auto x = static_cast<std::int64_t>(i) % room.rect.width, y = static_cast<std::int64_t>(i) / room.rect.width;
    const Rgb grey = colour_of(Ramp::greys, map.m[i]);
    const bool surface = room.truth.at(room.rect.x + x, room.rect.y + y) == scenes::TruthCell::surface;
    return ways && surface ? blend(grey, kTrue, 0.6) : grey;
  });
  const int foot = kHead_px + frame.height_px() + 8;
  draw_scale_bar(canvas, canvas.width() - kMargin_px, foot, scale / map.layers.cell_m);
  if (!ways) return canvas;
  const auto px = [&](GridCell c) {
    return std::pair{frame.left + (c.x + 0.5) * scale,
                     frame.top + (static_cast<double>(room.rect.height) - c.y - 0.5) * scale};
  };
  for (std::size_t r = 0; r < map.ways.size(); ++r) {
    const auto& cells = map.ways[r].cells;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const auto [x0, y0] = px(cells[i - 1]);
      const auto [x1, y1] = px(cells[i]);
      canvas.line(x0, y0, x1, y1, 2, kColours[r % kColours.size()]);
    }
    canvas.text(kMargin_px + static_cast<int>(r) * 34, foot, room.routes[r].name, 2, kColours[r % kColours.size()]);
  }
  for (std::size_t r = 0; r < room.routes.size(); ++r) {
    for (const GridCell end : {room.routes[r].from, room.routes[r].to}) {
      const auto [x, y] = px(end);
      canvas.disc(x, y, 5, kPaper);
      canvas.disc(x, y, 3.5, kColours[r % kColours.size()]);
    }
  }
  return canvas;
}

}  // namespace evigrid::driver::asharif2001
