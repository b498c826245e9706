// SPDX-License-Identifier: Apache-2.0
// Small maps are enlarged by a whole factor, so that cells stay squares; large ones keep one pixel a cell.
#include "picture/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace evigrid::driver {
namespace {

constexpr Rgb kUnknown{158, 158, 158}, kEmpty{250, 250, 247}, kOccupied{14, 22, 56}, kConflict{230, 159, 0};
constexpr Rgb kLethal{204, 51, 17};  // of the cost map: outside viridis
constexpr int kLongSide_px = 900;    // at least, on screen
constexpr int kLeastWidth_px = 780;  // for title and legend
constexpr int kFoot_px = 64;

float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

std::uint8_t mix(float e, float o, float u, float c, std::uint8_t Rgb::*part) {
  const float calm = e * kEmpty.*part + o * kOccupied.*part + u * kUnknown.*part;
  return static_cast<std::uint8_t>(std::clamp(std::lround((1 - c) * calm + c * kConflict.*part), 0L, 255L));
}

/// Title, map and two rows below it; `beside_px` of room to the right of the map.
struct Page {
  Canvas canvas;
  MapFrame frame;
  int foot;  // y of the first row below the map
};
Page page_of(const Layers& layers, const PictureText& text, const PictureOptions& options, int beside_px) {
  const CellRect& r = layers.rect;
  const int scale = options.scale > 0 ? options.scale : scale_for(r, kLongSide_px);
  const std::int64_t map_px = r.width * scale;
  const std::int64_t width = std::max<std::int64_t>(map_px + beside_px, kLeastWidth_px) + 2 * kMargin_px;
  const std::int64_t least = beside_px > 0 ? 200 : 0;  // a colour bar is never shorter
  const std::int64_t height = std::max(r.height * scale, least) + kHead_px + kFoot_px + kMargin_px;
  Page page{canvas_within(width, height, options), {}, 0};
  page.frame = {static_cast<int>((width - map_px - beside_px) / 2), kHead_px, scale, r, layers.cell_m};
  page.foot = static_cast<int>(height) - kFoot_px;
  draw_head(page.canvas, text);
  return page;
}

void draw_foot(Page& page, const std::vector<std::pair<Rgb, std::string_view>>& swatches, bool with_path) {
  int x = kMargin_px;
  for (const auto& [colour, label] : swatches) x = draw_swatch(page.canvas, x, page.foot, colour, label);
  if (with_path) draw_path_legend(page.canvas, kMargin_px, page.foot + kLine_px);
  draw_scale_bar(page.canvas, page.canvas.width() - kMargin_px, page.foot + kLine_px,
                 page.frame.scale / page.frame.cell_m);
}

Canvas draw_numbers(const LookRow& row, const Layers& layers, const std::vector<Pose2>& path, const PictureText& text,
                    const PictureOptions& options) {
  Page page = page_of(layers, {std::string(row.title), text.title + "; " + text.subtitle}, options, kColourBar_px + 12);
  const double top = top_of(row.look, layers);
  const bool costs = row.look == Look::costmap;
  const auto colour = [&](double v) {
    if (costs && v >= 253.5) return kLethal;
    return colour_of(*row.ramp, v / top);
  };
  draw_cells(page.canvas, page.frame, [&](std::size_t i) {
    const double v = value_of(row.look, layers, i);
    return never_seen(layers, i) || (costs && v == 255) ? kNeverSeen : colour(v);
  });
  draw_path(page.canvas, page.frame, path);
  const int bar_x = page.frame.left + page.frame.width_px() + 12;
  const int bar_h = std::clamp(page.frame.height_px() - kLine_px - 8, 150, 420);
  page.canvas.text(bar_x, kHead_px, row.unit, 2, kInk);
  draw_colour_bar(page.canvas, bar_x, kHead_px + kLine_px, bar_h, top, row.look == Look::conflict || row.look == Look::con, colour);
  std::vector<std::pair<Rgb, std::string_view>> swatches{{kNeverSeen, costs ? "no information (255)" : "never seen"}};
  if (costs) swatches.insert(swatches.begin(), {{kLethal, "lethal (254)"}, {colour(0), "free (0)"}});
  draw_foot(page, swatches, !path.empty());
  return std::move(page.canvas);
}

Canvas draw_composite(const Layers& layers, const std::vector<Pose2>& path, const PictureText& text,
                      const PictureOptions& options) {
  Page page = page_of(layers, {text.title + ": grey composite", text.subtitle}, options, 0);
  draw_cells(page.canvas, page.frame,
             [&](std::size_t i) { return composite_grey(layers.e()[i], layers.o()[i], layers.u()[i]); });
  draw_path(page.canvas, page.frame, path);
  draw_foot(
      page,
      {{composite_grey(1, 0, 0), "empty"}, {composite_grey(0, 0, 1), "unknown"}, {composite_grey(0, 1, 0), "occupied"}},
      !path.empty());
  return std::move(page.canvas);
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

Canvas canvas_within(std::int64_t width, std::int64_t height, const PictureOptions& options) {
  constexpr double kSide = 0x7FFFFFFF;  // PNG's own limit
  const double w = static_cast<double>(width), h = static_cast<double>(height);
  require_fits(options.name, fmt::format("{} x {} pixels", width, height),
               std::max(w, h) > kSide ? std::numeric_limits<double>::infinity() : 3 * w * h, options.max_image_mb);
  return Canvas(static_cast<int>(width), static_cast<int>(height), kPaper);
}

Canvas draw_map(const Layers& layers, const std::vector<Pose2>& path, const PictureText& text,
                const PictureOptions& options) {
  Page page = page_of(layers, text, options, 0);
  draw_cells(page.canvas, page.frame, [&](std::size_t i) {
    return cell_colour(layers.e()[i], layers.o()[i], layers.u()[i], layers.conflict()[i]);
  });
  draw_path(page.canvas, page.frame, path);
  draw_foot(page, {{kEmpty, "empty"}, {kOccupied, "occupied"}, {kUnknown, "unknown"}, {kConflict, "conflict"}},
            !path.empty());
  return std::move(page.canvas);
}

Canvas draw(Look look, const Layers& layers, const std::vector<Pose2>& path, const PictureText& text,
            const PictureOptions& options) {
  switch (look) {
    case Look::mixed:
      return draw_map(layers, path, text, options);
    case Look::composite:
      return draw_composite(layers, path, text, options);
    case Look::panels:
      return draw_panels(layers, path, text, options);
    case Look::surface:
      return draw_surface(layers, text, options);
    default:
      return draw_numbers(row_of(look), layers, path, text, options);
  }
}

}  // namespace evigrid::driver
