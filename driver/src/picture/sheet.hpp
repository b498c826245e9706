// SPDX-License-Identifier: Apache-2.0
// A contact sheet: maps of one place side by side at one scale, the true world first where it is known, each with its
// name and a few figures under it.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "evigrid/scenes/truth.hpp"
#include "out/layers.hpp"
#include "picture/canvas.hpp"

namespace evigrid::driver {

/// The masses of a map, reduced to what a panel of a sheet needs.
struct Thumbnail {
  int width = 0, height = 0;  ///< pixels
  std::vector<Rgb> pixels;    ///< row 0 on top
};

struct Panel {
  std::string title;
  std::vector<std::string> lines;
  Thumbnail picture;
};

/// The part of the plane that all panels show, and how many cells a pixel (or pixels a cell) of it.
struct SheetScale {
  CellRect rect{};
  int cells_per_px = 1, px_per_cell = 1;  ///< one of them is 1
};
[[nodiscard]] SheetScale sheet_scale(const CellRect& rect, int panel_px);

/// Rank and colour of the cell (x, y): of the cells under one pixel the one with the highest rank is shown.
using CellPainter = std::function<std::pair<float, Rgb>(std::int64_t x, std::int64_t y)>;
[[nodiscard]] Thumbnail thumbnail_of(const SheetScale& scale, const CellPainter& cell);

/// A pixel of several cells shows its most occupied cell, so that thin walls stay.
[[nodiscard]] Thumbnail thumbnail(const Layers& map, const SheetScale& scale);
[[nodiscard]] Thumbnail thumbnail(const scenes::TruthGrid& truth, const SheetScale& scale);

[[nodiscard]] Canvas draw_sheet(const std::string& title, const std::vector<Panel>& panels, int columns);

}  // namespace evigrid::driver
