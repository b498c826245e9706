// SPDX-License-Identifier: Apache-2.0
// The picture: colours apart, also for the colour-blind; a valid PNG; nothing outside the canvas.
#include <png.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "picture/font.hpp"
#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

int luminance(Rgb c) { return (299 * c.r + 587 * c.g + 114 * c.b) / 1000; }

Layers one_of_each() {
  Layers l;
  l.rect = {0, 0, 4, 1};
  l.cell_m = 0.1;
  l.planes = {1, 0, 0, 0.5F, /**/ 0, 1, 0, 0.5F, /**/ 0, 0, 1, 0, /**/ 0, 0, 0, 3};
  return l;
}

TEST(Colours, ApartInLightnessOrHue) {
  const Rgb empty = cell_colour(1, 0, 0, 0), occupied = cell_colour(0, 1, 0, 0), unknown = cell_colour(0, 0, 1, 0),
            conflict = cell_colour(0.5F, 0.5F, 0, 3);
  EXPECT_GT(luminance(empty), luminance(unknown) + 70);
  EXPECT_GT(luminance(unknown), luminance(occupied) + 70);
  EXPECT_EQ(conflict, (Rgb{230, 159, 0}));
  EXPECT_EQ(cell_colour(0.9F, 0.1F, 0, 50), cell_colour(0.9F, 0.1F, 0, 0));  // settled: its past does not colour it
}

TEST(Picture, EachCellHasItsColourAndThePathIsThere) {
  const Canvas c = draw_map(one_of_each(), {{0.05, 0.02, 0}, {0.35, 0.02, 0}}, {"t", "s"});
  EXPECT_GE(c.width(), 900);
  const int left = (c.width() - 900) / 2, cell = 225, top = 52;
  for (int i = 0; i < 4; ++i) {
    const float e = i == 0   ? 1.0F
                    : i == 3 ? 0.5F
                             : 0.0F,
                o = i == 1   ? 1.0F
                    : i == 3 ? 0.5F
                             : 0.0F,
                u = i == 2 ? 1.0F : 0.0F;
    EXPECT_EQ(c.get(left + i * cell + cell / 2, top + 20), cell_colour(e, o, u, i == 3 ? 3.0F : 0.0F)) << i;
  }
  EXPECT_EQ(c.get(left + 2 * cell, top + 180), (Rgb{0, 114, 178}));  // y = 0.02 m: near the lower edge
}

TEST(Picture, TheLargestYIsOnTop) {
  Layers l;
  l.rect = {0, 0, 1, 2};
  l.cell_m = 0.1;
  l.planes = {1, 0, /**/ 0, 1, /**/ 0, 0, /**/ 0, 0};  // below empty, above occupied
  const Canvas c = draw_map(l, {}, {"t", "s"});
  EXPECT_EQ(c.get(c.width() / 2, 52 + 200), cell_colour(0, 1, 0, 0));
  EXPECT_EQ(c.get(c.width() / 2, 52 + 700), cell_colour(1, 0, 0, 0));
}

TEST(Picture, AbsurdPosesDoNoHarm) {
  const double inf = std::numeric_limits<double>::infinity();
  const Canvas c = draw_map(one_of_each(), {{1e300, -1e300, 0}, {inf, 0, 0}, {NAN, 1, 0}}, {"t", "s"});
  EXPECT_GE(c.width(), 900);
}

TEST(Picture, LargeMapsKeepOnePixelACell) {
  Layers l;
  l.rect = {0, 0, 2000, 3};
  l.cell_m = 0.1;
  l.planes.assign(4 * 6000, 0);
  EXPECT_EQ(draw_map(l, {}, {"", ""}).width(), 2032);
}

TEST(Png, ReadsBackPixelForPixel) {
  Canvas c(3, 2, {1, 2, 3});
  c.set(2, 1, {200, 100, 50});
  c.set(-1, 0, {9, 9, 9});
  c.set(3, 0, {9, 9, 9});
  const auto bytes = png(c);
  ASSERT_GE(bytes.size(), 8u);
  EXPECT_EQ(png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8), 0);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
  image.format = PNG_FORMAT_RGB;
  ASSERT_EQ(image.width, 3u);
  ASSERT_EQ(image.height, 2u);
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(pixels[0], 1);
  EXPECT_EQ(pixels[15], 200);
  EXPECT_EQ(pixels[16], 100);
}

TEST(Font, EveryPrintableLetterDiffers) {
  for (char a = ' '; a <= '~'; ++a) {
    for (char b = static_cast<char>(a + 1); b <= '~'; ++b) EXPECT_NE(glyph_of(a), glyph_of(b)) << a << b;
  }
}

}  // namespace
}  // namespace evigrid::driver
