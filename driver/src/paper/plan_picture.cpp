// SPDX-License-Identifier: Apache-2.0
#include "paper/plan_picture.hpp"

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "score/truth.hpp"

namespace evigrid::driver {
namespace {

constexpr double kSide_px = 900, kLeastCell_m = 0.01;
constexpr int kLeastWidth_px = 620;
constexpr Rgb kOutside{222, 222, 222};

}  // namespace

Canvas draw_plan(const scenes::Scene& scene, const PictureText& text, const std::vector<PlanDrawn>& drawn) {
  const scenes::Extent box = scenes::extent(scene.world);
  const double side_m = std::max(box.high.x_m - box.low.x_m, box.high.y_m - box.low.y_m);
  const double cell_m = std::max(side_m / kSide_px, kLeastCell_m);
  const SceneTruth truth = scene_truth(scene, cell_m);
  if (!truth.grid) throw InputError("the true room: " + truth.why_not);
  const scenes::TruthGrid& t = *truth.grid;
  MapFrame frame{kMargin_px, kHead_px, 1, {t.x, t.y, t.width, t.height}, cell_m};
  frame.scale = std::max(1, static_cast<int>(kSide_px / static_cast<double>(std::max(t.width, t.height))));
  const int rows = 1 + static_cast<int>(std::count_if(drawn.begin(), drawn.end(),
                                                      [](const PlanDrawn& d) { return !d.name.empty(); }));
  Canvas canvas(std::max(frame.width_px(), kLeastWidth_px) + 2 * kMargin_px,
                kHead_px + frame.height_px() + rows * kLine_px + 2 * kMargin_px, kPaper);
  draw_head(canvas, text);
  draw_cells(canvas, frame, [&](std::size_t i) {
    return t.cells[i] == scenes::TruthCell::surface ? kBuildingColour
           : t.cells[i] == scenes::TruthCell::free  ? kPaper
                                                    : kOutside;
  });
  for (const PlanDrawn& d : drawn) {
    for (std::size_t i = 0; i < d.points.size(); ++i) {
      const double x = frame.x(d.points[i].x_m), y = frame.y(d.points[i].y_m);
      if (!d.line) {
        canvas.disc(x, y, 4.5, kPaper);
        canvas.disc(x, y, 3.5, d.colour);
      } else if (i > 0) {
        canvas.line(frame.x(d.points[i - 1].x_m), frame.y(d.points[i - 1].y_m), x, y, 2, d.colour);
      }
    }
  }
  int y = kHead_px + frame.height_px() + kMargin_px;
  for (const PlanDrawn& d : drawn) {
    if (d.name.empty()) continue;
    draw_swatch(canvas, kMargin_px, y, d.colour, d.name);
    y += kLine_px;
  }
  draw_scale_bar(canvas, canvas.width() - kMargin_px, y, frame.scale / cell_m);
  return canvas;
}

}  // namespace evigrid::driver
