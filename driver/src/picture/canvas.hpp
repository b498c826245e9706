// SPDX-License-Identifier: Apache-2.0
// A small RGB image to draw on. Pixels, row 0 on top; everything outside is clipped.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace evigrid::driver {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

class Canvas {
 public:
  Canvas(int width, int height, Rgb fill);
  void set(int x, int y, Rgb);
  [[nodiscard]] Rgb get(int x, int y) const;
  void rect(int x, int y, int width, int height, Rgb);
  void line(double x0, double y0, double x1, double y1, int thickness, Rgb);
  void disc(double x, double y, double radius, Rgb);
  /// A circle line, `width` thick inwards from `radius`.
  void ring(double x, double y, double radius, double width, Rgb);
  /// Built-in letters of 5 × 7 pixels (tails reach two lower), each `scale` wide; the pen advances 6 · scale a letter.
  void text(int x, int y, std::string_view, int scale, Rgb);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const std::uint8_t* row(int y) const {
    return &pixels_[static_cast<std::size_t>(y) * 3 * static_cast<std::size_t>(width_)];
  }

 private:
  int width_, height_;
  std::vector<std::uint8_t> pixels_;
};

constexpr int text_width(std::string_view text, int scale) { return static_cast<int>(text.size()) * 6 * scale; }

/// Half the size, every pixel the mean of four: what was drawn twice as large has smooth edges now.
Canvas halved(const Canvas&);

/// The image as a PNG file in memory.
std::vector<std::byte> png(const Canvas&);

}  // namespace evigrid::driver
