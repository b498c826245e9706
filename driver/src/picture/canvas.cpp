// SPDX-License-Identifier: Apache-2.0
// Filled shapes without anti-aliasing: crisp at any scale, and the same bytes everywhere.
#include "picture/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "picture/font.hpp"

namespace evigrid::driver {

Canvas::Canvas(int width, int height, Rgb fill)
    : width_(width), height_(height), pixels_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  rect(0, 0, width, height, fill);
}

void Canvas::set(int x, int y, Rgb colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  std::uint8_t* p =
      &pixels_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x))];
  p[0] = colour.r;
  p[1] = colour.g;
  p[2] = colour.b;
}

Rgb Canvas::get(int x, int y) const {
  const std::uint8_t* p = row(y) + 3 * static_cast<std::size_t>(x);
  return {p[0], p[1], p[2]};
}

void Canvas::rect(int x, int y, int width, int height, Rgb colour) {
  for (int iy = std::max(y, 0); iy < std::min(y + height, height_); ++iy) {
    for (int ix = std::max(x, 0); ix < std::min(x + width, width_); ++ix) set(ix, iy, colour);
  }
}

void Canvas::line(double x0, double y0, double x1, double y1, int thickness, Rgb colour) {
  const double length = std::max(std::abs(x1 - x0), std::abs(y1 - y0));
  const int steps = static_cast<int>(std::min(std::ceil(length), 1e5)) + 1;  // an absurd pose must not take for ever
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double x = x0 + t * (x1 - x0), y = y0 + t * (y1 - y0);
    if (!(std::abs(x) < 1e6 && std::abs(y) < 1e6)) continue;
    rect(static_cast<int>(std::floor(x)) - thickness / 2, static_cast<int>(std::floor(y)) - thickness / 2, thickness,
         thickness, colour);
  }
}

void Canvas::disc(double x, double y, double radius, Rgb colour) {
  if (!(std::abs(x) < 1e6 && std::abs(y) < 1e6)) return;
  const int r = static_cast<int>(std::ceil(radius)), cx = static_cast<int>(x), cy = static_cast<int>(y);
  for (int iy = -r; iy <= r; ++iy) {
    for (int ix = -r; ix <= r; ++ix) {
      if (ix * ix + iy * iy <= radius * radius) set(cx + ix, cy + iy, colour);
    }
  }
}

void Canvas::ring(double x, double y, double radius, double width, Rgb colour) {
  if (!(std::abs(x) < 1e6 && std::abs(y) < 1e6)) return;
  const int r = static_cast<int>(std::ceil(radius)), cx = static_cast<int>(x), cy = static_cast<int>(y);
  for (int iy = -r; iy <= r; ++iy) {
    for (int ix = -r; ix <= r; ++ix) {
      const double d = std::sqrt(ix * ix + iy * iy);
      if (d <= radius && d > radius - width) set(cx + ix, cy + iy, colour);
    }
  }
}

void Canvas::text(int x, int y, std::string_view text, int scale, Rgb colour) {
  for (const char c : text) {
    const Glyph& glyph = glyph_of(c);
    for (int row = 0; row < static_cast<int>(glyph.size()); ++row) {
      for (int column = 0; column < 5; ++column) {
        if ((glyph[static_cast<std::size_t>(row)] >> (4 - column)) & 1) {
          rect(x + column * scale, y + row * scale, scale, scale, colour);
        }
      }
    }
    x += 6 * scale;
  }
}

Canvas halved(const Canvas& in) {
  Canvas out(in.width() / 2, in.height() / 2, {});
  for (int y = 0; y < out.height(); ++y) {
    const std::uint8_t *above = in.row(2 * y), *below = in.row(2 * y + 1);
    for (int x = 0; x < out.width(); ++x) {
      const auto mean = [&](int part) {
        const int i = 6 * x + part;
        return static_cast<std::uint8_t>((above[i] + above[i + 3] + below[i] + below[i + 3] + 2) / 4);
      };
      out.set(x, y, {mean(0), mean(1), mean(2)});
    }
  }
  return out;
}

}  // namespace evigrid::driver
