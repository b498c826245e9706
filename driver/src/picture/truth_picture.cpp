// SPDX-License-Identifier: Apache-2.0
// Colours: found and missed walls, walls seen where there are none, and empty where it is, is not, or is not known.
#include "picture/truth_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "picture/furniture.hpp"

namespace evigrid::driver {
namespace {

constexpr Rgb kFound{14, 22, 56}, kMissed{213, 94, 0}, kFalseWall{204, 121, 167}, kRightlyEmpty{250, 250, 247},
    kFalseEmpty{86, 180, 233}, kUnknown{190, 190, 190}, kSolid{222, 222, 222},
    kBehind{112, 122, 160};
constexpr int kSide_px = 800, kLeastWidth_px = 860;

/// `visible`: a surface that borders free space; the others no sensor can see.
Rgb colour_of(scenes::TruthCell truth, Decision said, bool visible) {
  if (truth == scenes::TruthCell::free)
    return said == Decision::occupied ? kFalseWall : said == Decision::empty ? kRightlyEmpty : kUnknown;
  if (said == Decision::occupied) return truth == scenes::TruthCell::surface ? kFound : kBehind;
  if (said == Decision::empty) return kFalseEmpty;
  return visible ? kMissed : kSolid;
}

}  // namespace

Canvas draw_truth(const Overlay& o, const Score& s, double cell_m, const std::string& name, int cap_mb) {
  MapFrame frame;
  frame.rect = o.rect;
  frame.cell_m = cell_m;
  frame.scale = scale_for(o.rect, kSide_px);
  const double width = std::max<double>(static_cast<double>(o.rect.width) * frame.scale, kLeastWidth_px) + 2 * kMargin_px,
               height = static_cast<double>(o.rect.height) * frame.scale + kHead_px + 2 * kLine_px + 2 * kMargin_px;
  require_fits("truth.png", fmt::format("{:.0f} x {:.0f} pixels", width, height), 3 * width * height, cap_mb);
  Canvas canvas(static_cast<int>(width), static_cast<int>(height), kPaper);
  frame.left = (canvas.width() - frame.width_px()) / 2;
  frame.top = kHead_px;
  draw_head(canvas, {fmt::format("evigrid: {}, the map against the true world", name),
                     fmt::format("strict: precision {:.3f}, recall {:.3f}, mistaken {:.4f}; within one cell: {:.3f}, "
                                 "{:.3f}, {:.4f}; cell {:g} m",
                                 s.strict.precision, s.strict.recall, s.strict.mistaken_rate, s.near.precision,
                                 s.near.recall, s.near.mistaken_rate, cell_m)});
  draw_cells(canvas, frame, [&](std::size_t i) { return colour_of(o.truth[i], o.map[i], visible_wall(o, i)); });
  int x = kMargin_px, y = frame.top + frame.height_px() + kMargin_px;
  for (const auto& [colour, label] : {std::pair{kFound, "wall found"}, {kMissed, "wall missed"},
                                      {kFalseWall, "wall where free"}, {kFalseEmpty, "empty where wall"}}) {
    x = draw_swatch(canvas, x, y, colour, label);
  }
  x = kMargin_px, y += kLine_px;
  for (const auto& [colour, label] :
       {std::pair{kRightlyEmpty, "empty"}, {kUnknown, "free, not known"}, {kBehind, "wall out of sight"}, {kSolid, "out of sight"}}) {
    x = draw_swatch(canvas, x, y, colour, label);
  }
  draw_scale_bar(canvas, canvas.width() - kMargin_px, y, frame.scale / cell_m);
  return canvas;
}

}  // namespace evigrid::driver
