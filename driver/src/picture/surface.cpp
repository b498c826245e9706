// SPDX-License-Identifier: Apache-2.0
// A height field in parallel projection: two triangles between four neighbours, hidden ones removed by a depth buffer,
// light from the upper left, drawn twice as large and halved. Units of the box: the longer side of the map is 1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "picture/heights.hpp"
#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

constexpr int kWidth_px = 1200, kSuper = 2, kMostBlocks = 240;
constexpr double kAzimuth_rad = -35 * std::numbers::pi / 180, kElevation_rad = 38 * std::numbers::pi / 180;
constexpr double kHeight = 0.12;  // of z = 1 in the box
constexpr Rgb kWall{243, 243, 243}, kGrid{208, 208, 208}, kGround{196, 196, 196};

struct Point {
  double x, y, depth;  ///< pixels, and away from the eye
};

class Scene {
 public:
  Scene(Canvas canvas, double half_x, double half_y)
      : canvas_(std::move(canvas)),
        depth_(static_cast<std::size_t>(canvas_.width()) * static_cast<std::size_t>(canvas_.height()),
               std::numeric_limits<float>::infinity()) {
    double x0 = 1e9, x1 = -1e9, y1 = -1e9;
    for (const double x : {-half_x, half_x}) {
      for (const double y : {-half_y, half_y}) {
        for (const double z : {0.0, 1.0}) {
          const Point p = turned(x, y, z);
          x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y1 = std::max(y1, p.y);
        }
      }
    }
    constexpr int kSide_px = 110 * kSuper, kTop_px = 78 * kSuper;
    scale_ = (canvas_.width() - 2 * kSide_px) / (x1 - x0);
    left_ = kSide_px - x0 * scale_;
    top_ = kTop_px + y1 * scale_;
  }
  /// @param z 0 … 1.
  [[nodiscard]] Point project(double x, double y, double z) const {
    const Point p = turned(x, y, z);
    return {left_ + p.x * scale_, top_ - p.y * scale_, p.depth};
  }
  /// How high the canvas must be for that map.
  static int height_px(double half_x, double half_y) {
    const double s = std::abs(std::sin(kAzimuth_rad)), c = std::cos(kAzimuth_rad);
    const double wide = 2 * (half_x * c + half_y * s), deep = 2 * (half_x * s + half_y * c);
    const double per = (kWidth_px - 220) / wide;
    return static_cast<int>((deep * std::sin(kElevation_rad) + kHeight * std::cos(kElevation_rad)) * per) + 78 + 96;
  }
  Canvas& canvas() { return canvas_; }

  void line(const Point& a, const Point& b, int thickness, Rgb colour) {
    canvas_.line(a.x, a.y, b.x, b.y, thickness, colour);
  }

  /// @param value at the corners; colour(interpolated value) fills where nothing nearer was drawn.
  template <class F>
  void triangle(const std::array<Point, 3>& p, const std::array<double, 3>& value, F&& colour) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (std::abs(area) < 1e-12) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min({p[0].x, p[1].x, p[2].x}))));
    const int x1 = std::min(canvas_.width() - 1, static_cast<int>(std::ceil(std::max({p[0].x, p[1].x, p[2].x}))));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min({p[0].y, p[1].y, p[2].y}))));
    const int y1 = std::min(canvas_.height() - 1, static_cast<int>(std::ceil(std::max({p[0].y, p[1].y, p[2].y}))));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double b = ((px - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (py - p[0].y)) / area;
        const double c = ((p[1].x - p[0].x) * (py - p[0].y) - (px - p[0].x) * (p[1].y - p[0].y)) / area;
        const double a = 1 - b - c;
        if (a < -1e-9 || b < -1e-9 || c < -1e-9) continue;
        const auto depth = static_cast<float>(a * p[0].depth + b * p[1].depth + c * p[2].depth);
        float& nearest = depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas_.width()) +
                                static_cast<std::size_t>(x)];
        if (depth >= nearest) continue;
        nearest = depth;
        canvas_.set(x, y, colour(a * value[0] + b * value[1] + c * value[2]));
      }
    }
  }

 private:
  static Point turned(double x, double y, double z) {
    const double right = x * std::cos(kAzimuth_rad) - y * std::sin(kAzimuth_rad);
    const double away = x * std::sin(kAzimuth_rad) + y * std::cos(kAzimuth_rad);
    const double up = z * kHeight;
    return {right, up * std::cos(kElevation_rad) + away * std::sin(kElevation_rad),
            away * std::cos(kElevation_rad) - up * std::sin(kElevation_rad)};
  }
  Canvas canvas_;
  std::vector<float> depth_;
  double scale_ = 1, left_ = 0, top_ = 0;
};

void draw_quads(Scene& scene, const Heights& h) {
  const double light[] = {-0.45, -0.35, 0.82};  // towards the lamp, in the box
  for (int j = 0; j + 1 < h.ny; ++j) {
    for (int i = 0; i + 1 < h.nx; ++i) {
      const std::array<std::pair<int, int>, 4> corner{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
      std::array<Point, 4> p{};
      std::array<double, 4> z{};
      bool seen = false;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [ci, cj] = corner[k];
        z[k] = h.bel[h.at(ci, cj)];
        seen = seen || h.seen[h.at(ci, cj)];
        p[k] = scene.project(h.x[static_cast<std::size_t>(ci)], h.y[static_cast<std::size_t>(cj)], z[k]);
      }
      const double dx = h.x[static_cast<std::size_t>(i) + 1] - h.x[static_cast<std::size_t>(i)];
      const double dy = h.y[static_cast<std::size_t>(j) + 1] - h.y[static_cast<std::size_t>(j)];
      const double nx = -0.5 * kHeight * (z[1] + z[2] - z[0] - z[3]) / dx;
      const double ny = -0.5 * kHeight * (z[2] + z[3] - z[0] - z[1]) / dy;
      const double lit = (nx * light[0] + ny * light[1] + light[2]) / std::sqrt(nx * nx + ny * ny + 1);
      const double shade = 0.62 + 0.38 * std::clamp(lit / light[2], 0.0, 1.0);
      const auto colour = [&](double bel) {
        return blend({0, 0, 0}, seen ? colour_of(Ramp::viridis, bel) : kGround, shade);
      };
      scene.triangle({p[0], p[1], p[2]}, {z[0], z[1], z[2]}, colour);
      scene.triangle({p[0], p[2], p[3]}, {z[0], z[2], z[3]}, colour);
    }
  }
}

/// A round step that divides `length` into three to eight parts.
double step_of(double length) {
  double step = std::pow(10, std::floor(std::log10(length / 3)));
  for (const double next : {2.0, 2.5, 2.0}) {
    if (length / step > 8) step *= next;
  }
  return step;
}

/// Walls behind, with their grid, and the numbers along the two sides in front and up the left corner.
void draw_box(Scene& s, const Layers& l, double half_x, double half_y, bool behind) {
  constexpr int kText = 2 * kSuper;
  const double longest_m = static_cast<double>(std::max(l.rect.width, l.rect.height)) * l.cell_m;
  const auto wall = [&](std::array<Point, 4> q) {
    s.triangle({q[0], q[1], q[2]}, {0, 0, 0}, [](double) { return kWall; });
    s.triangle({q[0], q[2], q[3]}, {0, 0, 0}, [](double) { return kWall; });
  };
  if (behind) {
    wall({s.project(-half_x, half_y, 0), s.project(half_x, half_y, 0), s.project(half_x, half_y, 1),
          s.project(-half_x, half_y, 1)});
    wall({s.project(-half_x, -half_y, 0), s.project(-half_x, half_y, 0), s.project(-half_x, half_y, 1),
          s.project(-half_x, -half_y, 1)});
  }
  const auto ticks = [&](double from_m, double length_m, auto&& at) {
    const double step = step_of(length_m);
    for (double t = std::ceil(from_m / step - 1e-9) * step; t <= from_m + length_m + 1e-9 * step; t += step)
      at(t, (t - from_m - length_m / 2) / longest_m, fmt::format("{:g}", std::abs(t) < step * 1e-6 ? 0 : t));
  };
  const double x_m = static_cast<double>(l.rect.x) * l.cell_m, y_m = static_cast<double>(l.rect.y) * l.cell_m;
  const double w_m = static_cast<double>(l.rect.width) * l.cell_m, h_m = static_cast<double>(l.rect.height) * l.cell_m;
  ticks(x_m, w_m, [&](double, double x, const std::string& label) {
    if (behind) return s.line(s.project(x, half_y, 0), s.project(x, half_y, 1), kSuper, kGrid);
    const Point p = s.project(x, -half_y, 0);
    s.canvas().rect(static_cast<int>(p.x), static_cast<int>(p.y), kSuper, 6 * kSuper, kInk);
    s.canvas().text(static_cast<int>(p.x) - text_width(label, kText) / 2 - 6 * kSuper,
                    static_cast<int>(p.y) + 9 * kSuper, label, kText, kInk);
  });
  ticks(y_m, h_m, [&](double, double y, const std::string& label) {
    if (behind) return s.line(s.project(-half_x, y, 0), s.project(-half_x, y, 1), kSuper, kGrid);
    const Point p = s.project(half_x, y, 0);
    s.canvas().rect(static_cast<int>(p.x), static_cast<int>(p.y), kSuper, 6 * kSuper, kInk);
    s.canvas().text(static_cast<int>(p.x) + 6 * kSuper, static_cast<int>(p.y) + 9 * kSuper, label, kText, kInk);
  });
  for (int i = 0; i <= 2; ++i) {
    const double z = i / 2.0;
    if (behind) {
      s.line(s.project(-half_x, -half_y, z), s.project(-half_x, half_y, z), kSuper, kGrid);
      s.line(s.project(-half_x, half_y, z), s.project(half_x, half_y, z), kSuper, kGrid);
      continue;
    }
    const Point p = s.project(-half_x, -half_y, z);
    const std::string label = fmt::format("{:g}", z);
    s.canvas().rect(static_cast<int>(p.x) - 6 * kSuper, static_cast<int>(p.y), 6 * kSuper, kSuper, kInk);
    s.canvas().text(static_cast<int>(p.x) - 9 * kSuper - text_width(label, kText), static_cast<int>(p.y) - 7 * kSuper,
                    label, kText, kInk);
  }
  if (behind) return;
  s.line(s.project(-half_x, -half_y, 0), s.project(half_x, -half_y, 0), kSuper, kInk);
  s.line(s.project(half_x, -half_y, 0), s.project(half_x, half_y, 0), kSuper, kInk);
  s.line(s.project(-half_x, -half_y, 0), s.project(-half_x, -half_y, 1), kSuper, kInk);
  const Point x = s.project(0, -half_y, 0), y = s.project(half_x, 0, 0), z = s.project(-half_x, -half_y, 1);
  s.canvas().text(static_cast<int>(x.x) - 70 * kSuper, static_cast<int>(x.y) + 44 * kSuper, "x, m", kText, kInk);
  s.canvas().text(static_cast<int>(y.x) + 34 * kSuper, static_cast<int>(y.y) + 44 * kSuper, "y, m", kText, kInk);
  s.canvas().text(static_cast<int>(z.x) - 36 * kSuper, static_cast<int>(z.y) - 32 * kSuper, "Bel", kText, kInk);
}

}  // namespace

Canvas draw_surface(const Layers& layers, const PictureText& text, const PictureOptions& options) {
  const auto longest = static_cast<double>(std::max({layers.rect.width, layers.rect.height, std::int64_t{1}}));
  const double half_x = 0.5 * static_cast<double>(layers.rect.width) / longest;
  const double half_y = 0.5 * static_cast<double>(layers.rect.height) / longest;
  const int height = Scene::height_px(half_x, half_y);
  Scene scene(canvas_within(kSuper * kWidth_px, kSuper * height, options), half_x, half_y);
  draw_box(scene, layers, half_x, half_y, true);
  draw_quads(scene, heights_of(layers, kMostBlocks));
  draw_box(scene, layers, half_x, half_y, false);
  Canvas out = halved(scene.canvas());
  draw_head(out, {text.title + ": " + std::string(row_of(Look::surface).title), text.subtitle});
  draw_colour_bar(out, out.width() - kColourBar_px, kHead_px + 26, 110, 1, false,
                  [](double v) { return colour_of(Ramp::viridis, v); });
  draw_swatch(out, kMargin_px, out.height() - 30, kGround, "never seen");
  return out;
}

}  // namespace evigrid::driver
