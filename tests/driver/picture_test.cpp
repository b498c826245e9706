// SPDX-License-Identifier: Apache-2.0
// The picture: colours apart, also for the colour-blind; a valid PNG; nothing outside the canvas.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "driver/decoded_png.hpp"
#include "driver/text.hpp"
#include "error.hpp"
#include "picture/font.hpp"
#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

int luminance(const Rgb& c) { return (299 * c.r + 587 * c.g + 114 * c.b) / 1000; }

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
  const DecodedPng image = decode_png(bytes.data(), bytes.size());
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) EXPECT_EQ(image.get(x, y), c.get(x, y));
  }
}

TEST(Picture, StartAndEndAreBothSeenWhereTheyMeet) {
  const Canvas c = draw_map(one_of_each(), {{0.25, 0.05, 0}, {0.15, 0.05, 0}, {0.25, 0.05, 0}}, {"t", "s"});
  const int left = (c.width() - 900) / 2, x = left + 2 * 225 + 112, y = 52 + 112;
  EXPECT_EQ(c.get(x, y), (Rgb{0, 158, 115}));     // start: a disc
  EXPECT_EQ(c.get(x, y - 8), (Rgb{213, 94, 0}));  // end: a ring around it
  EXPECT_EQ(c.get(x + 8, y), (Rgb{213, 94, 0}));
}

TEST(Picture, ThePathIsSeenOnItsOwnColour) {
  Canvas c(60, 20, {0, 114, 178});
  draw_path(c, {0, 0, 1, {0, 0, 60, 20}, 1}, {{20, 10, 0}, {59, 10, 0}});
  EXPECT_EQ(c.get(40, 10), (Rgb{0, 114, 178}));
  EXPECT_EQ(c.get(40, 9), (Rgb{255, 255, 255}));
  EXPECT_EQ(c.get(40, 11), (Rgb{255, 255, 255}));
}

TEST(Picture, ACanvasAboveTheCapIsRefusedByName) {
  try {
    (void)draw_map(one_of_each(), {}, {"t", "s"}, {.scale = 20000, .max_image_mb = 100, .name = "some.png"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "some.png refused"));
    EXPECT_TRUE(contains(error.what(), "--max-image-mb 100"));
  }
  Layers thin = one_of_each();
  thin.rect = {0, 0, std::int64_t{1} << 40, 1};  // no canvas has such a side, whatever the cap
  EXPECT_THROW((void)draw_map(thin, {}, {"", ""}, {.max_image_mb = 2'000'000'000}), InputError);
}

TEST(Font, TailsReachBelowTheLine) {
  for (char c = '!'; c <= '~'; ++c) {
    const bool tail = glyph_of(c)[7] != 0 || glyph_of(c)[8] != 0;
    EXPECT_EQ(tail, std::string_view("gjpqy,;").find(c) != std::string_view::npos) << c;
  }
  Canvas canvas(12, 18, {255, 255, 255});
  canvas.text(0, 0, "p", 2, {0, 0, 0});
  EXPECT_EQ(canvas.get(0, 17), (Rgb{0, 0, 0}));
}

TEST(Canvas, HalvedIsTheMeanOfFour) {
  Canvas c(4, 2, {0, 0, 0});
  c.set(0, 0, {200, 40, 0});
  c.set(1, 1, {200, 0, 3});
  const Canvas half = halved(c);
  EXPECT_EQ(half.width(), 2);
  EXPECT_EQ(half.height(), 1);
  EXPECT_EQ(half.get(0, 0), (Rgb{100, 10, 1}));
  EXPECT_EQ(half.get(1, 0), (Rgb{0, 0, 0}));
}

TEST(Font, EveryPrintableLetterDiffers) {
  for (char a = ' '; a <= '~'; ++a) {
    for (char b = static_cast<char>(a + 1); b <= '~'; ++b) EXPECT_NE(glyph_of(a), glyph_of(b)) << a << b;
  }
}

}  // namespace
}  // namespace evigrid::driver
