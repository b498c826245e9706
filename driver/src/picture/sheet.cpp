// SPDX-License-Identifier: Apache-2.0
#include "picture/sheet.hpp"

#include <algorithm>

#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

constexpr Rgb kFrame{190, 190, 190};
constexpr Rgb kFree{250, 250, 247}, kWall{14, 22, 56}, kSolid{205, 205, 205}, kNothing{158, 158, 158};
constexpr int kGap_px = 18, kTitle_px = 22, kSheetLine_px = 14, kSheetHead_px = 44;

}  // namespace

SheetScale sheet_scale(const CellRect& rect, int panel_px) {
  SheetScale s;
  s.rect = rect;
  const std::int64_t longest = std::max<std::int64_t>({rect.width, rect.height, 1});
  s.cells_per_px = static_cast<int>((longest + panel_px - 1) / panel_px);
  s.px_per_cell = s.cells_per_px > 1 ? 1 : static_cast<int>(std::max<std::int64_t>(panel_px / longest, 1));
  return s;
}

Thumbnail thumbnail_of(const SheetScale& s, const CellPainter& cell) {
  Thumbnail out;
  const auto reduced = [&](std::int64_t cells) {
    return static_cast<int>((cells + s.cells_per_px - 1) / s.cells_per_px) * s.px_per_cell;
  };
  out.width = reduced(s.rect.width);
  out.height = reduced(s.rect.height);
  out.pixels.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int py = 0; py < out.height; ++py) {
    for (int px = 0; px < out.width; ++px) {
      const std::int64_t x0 = s.rect.x + px / s.px_per_cell * s.cells_per_px;
      const std::int64_t y0 = s.rect.y + (out.height - 1 - py) / s.px_per_cell * s.cells_per_px;
      float best = -1;
      Rgb colour = kNothing;
      for (std::int64_t y = y0; y < y0 + s.cells_per_px; ++y) {
        for (std::int64_t x = x0; x < x0 + s.cells_per_px; ++x) {
          const auto [rank, shown] = cell(x, y);
          if (rank > best) best = rank, colour = shown;
        }
      }
      out.pixels[static_cast<std::size_t>(py) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(px)] =
          colour;
    }
  }
  return out;
}

Thumbnail thumbnail(const Layers& map, const SheetScale& scale) {
  const CellRect& r = map.rect;
  return thumbnail_of(scale, [&](std::int64_t x, std::int64_t y) -> std::pair<float, Rgb> {
    x -= r.x, y -= r.y;
    if (x < 0 || y < 0 || x >= r.width || y >= r.height) return {-0.5F, kNothing};
    const auto i = static_cast<std::size_t>(y * r.width + x);
    return {map.o()[i], cell_colour(map.e()[i], map.o()[i], map.u()[i], map.conflict()[i])};
  });
}

Thumbnail thumbnail(const scenes::TruthGrid& truth, const SheetScale& scale) {
  return thumbnail_of(scale, [&](std::int64_t x, std::int64_t y) -> std::pair<float, Rgb> {
    if (x < truth.x || y < truth.y || x >= truth.x + truth.width || y >= truth.y + truth.height) return {0, kSolid};
    switch (truth.at(x, y)) {
      case scenes::TruthCell::surface:
        return {2, kWall};
      case scenes::TruthCell::free:
        return {1, kFree};
      case scenes::TruthCell::solid:
        break;
    }
    return {0, kSolid};
  });
}

Canvas draw_sheet(const std::string& title, const std::vector<Panel>& panels, int columns) {
  const int count = static_cast<int>(panels.size());
  columns = std::clamp(columns, 1, std::max(count, 1));
  const int rows = (count + columns - 1) / columns;
  int cell_w = 0, cell_h = 0;
  for (const Panel& p : panels) {
    int text_px = text_width(p.title, 2);
    for (const std::string& line : p.lines) text_px = std::max(text_px, text_width(line, 1));
    cell_w = std::max({cell_w, p.picture.width, text_px});
    cell_h = std::max(cell_h, p.picture.height + kTitle_px + kSheetLine_px * static_cast<int>(p.lines.size()) + 6);
  }
  const int width = std::max(columns * (cell_w + kGap_px) + kGap_px, text_width(title, 2) + 2 * kGap_px);
  Canvas canvas(width, kSheetHead_px + rows * (cell_h + kGap_px), kPaper);
  canvas.text(kGap_px, 14, title, 2, kInk);
  for (int i = 0; i < count; ++i) {
    const Panel& p = panels[static_cast<std::size_t>(i)];
    const int left = kGap_px + i % columns * (cell_w + kGap_px), top = kSheetHead_px + i / columns * (cell_h + kGap_px);
    canvas.text(left, top, p.title, 2, kInk);
    const int y0 = top + kTitle_px;
    canvas.rect(left - 1, y0 - 1, p.picture.width + 2, p.picture.height + 2, kFrame);
    for (int y = 0; y < p.picture.height; ++y) {
      for (int x = 0; x < p.picture.width; ++x) {
        canvas.set(left + x, y0 + y,
                   p.picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(p.picture.width) +
                                    static_cast<std::size_t>(x)]);
      }
    }
    int text_y = y0 + p.picture.height + 6;
    for (const std::string& line : p.lines) {
      canvas.text(left, text_y, line, 1, kInk);
      text_y += kSheetLine_px;
    }
  }
  return canvas;
}

}  // namespace evigrid::driver
