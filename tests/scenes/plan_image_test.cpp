// SPDX-License-Identifier: Apache-2.0
// Every kind of image is read as its format's document says, top row up, and each brightness gets the meaning it has in
// map_server. Images are made by the test (plan_files.hpp).
#include <gtest/gtest.h>

#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

using std::string;

string str(std::initializer_list<int> bytes) {
  string s;
  for (const int b : bytes) s += static_cast<char>(b);
  return s;
}

// Black, white, grey / black, black, black: not the same when mirrored in x or y.
const string kRows = "#.?\n###\n";

TEST(PlanImage, PlainPgmWithCommentsAnywhere) {
  EXPECT_EQ(rows_of(load_image("P2 3 2 255 0 255 128 0 0 0", "a.pgm")), kRows);
  EXPECT_EQ(rows_of(load_image("P2\n# by hand\n3 # width\n2# height\n# max:\n255\n0 255 128\n# lower row\n0 0 0#end",
                               "a.pgm")),
            kRows);
  EXPECT_EQ(rows_of(load_image("P2\r\n3 2\r\n255\r\n0 255 128\r\n0 0 0\r\n", "a.pgm")), kRows);
  EXPECT_EQ(rows_of(load_image("P2 3 2 255 0 255 128 0 0 0 77 99", "a.pgm")), kRows);  // more is ignored, as in netpbm
}

TEST(PlanImage, RawPgm) {
  EXPECT_EQ(rows_of(load_image("P5 3 2 255\n" + str({0, 255, 128, 0, 0, 0}), "a.pgm")), kRows);
  EXPECT_EQ(rows_of(load_image("P5\n# c\n3 2\n255# c\n" + str({0, 255, 128, 0, 0, 0}), "a.PGM")), kRows);
  // Exactly one white space before the data: 10, 35 ('#') are samples.
  EXPECT_EQ(rows_of(load_image("P5 3 1 255\n" + str({10, 35, 255}), "a.pgm")), "##.\n");
}

TEST(PlanImage, PgmOfAnyMaxval) {
  EXPECT_EQ(rows_of(load_image("P5 3 2 1\n" + str({0, 1, 1, 0, 0, 0}), "a.pgm")), "#..\n###\n");
  EXPECT_EQ(rows_of(load_image("P5 4 1 100\n" + str({0, 34, 35, 100}), "a.pgm")), "##?.\n");  // p = 1, .66, .65, 0
  EXPECT_EQ(rows_of(load_image("P5 3 1 65535\n" + str({0, 255, 255, 255, 128, 0}), "a.pgm")), "#.?\n");
  EXPECT_EQ(rows_of(load_image("P5 2 1 256\n" + str({1, 0, 0, 0}), "a.pgm")), ".#\n");
  EXPECT_EQ(rows_of(load_image("P2 3 1 65535 22937 22938 65535", "a.pgm")), "#?.\n");  // p = 0.650004, 0.649989
  EXPECT_EQ(refusal("P5 1 1 100\n" + str({101}), "a.pgm", {.resolution_m = 1}),
            "a.pgm: pixel 0: is 101, greater than maxval 100");
}

TEST(PlanImage, ThresholdsAreStrictAsInMapServer) {
  // Grey 205 of map_saver's unknown: p = 50/255 = 0.196078 > 0.196.
  EXPECT_EQ(rows_of(load_image("P2 4 1 255 205 206 89 90", "a.pgm")), "?.#?\n");
  ImageScale scale;
  scale.occupied_threshold = scale.free_threshold = 0.5;  // p = 0.5 itself is neither
  EXPECT_EQ(rows_of(load_image("P2 3 1 2 0 1 2", "a.pgm", scale)), "#?.\n");
  scale = {};
  scale.negate = true;
  EXPECT_EQ(rows_of(load_image("P2 3 1 255 0 255 128", "a.pgm", scale)), ".#?\n");
}

TEST(PlanImage, GreyPng) {
  EXPECT_EQ(rows_of(load_image(Png{3, 2, 8, 0, 0, str({0, 0, 255, 128, 0, 0, 0, 0})}.file(), "a.png")), kRows);
  EXPECT_EQ(rows_of(load_image(Png{3, 2, 1, 0, 0, str({0, 0x40, 0, 0})}.file(), "a.png")), "#.#\n###\n");
  EXPECT_EQ(rows_of(load_image(Png{9, 1, 1, 0, 0, str({0, 0x7f, 0x80})}.file(), "a.png")), "#........\n");
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 2, 0, 0, str({0, 0x34})}.file(), "a.png")), "#.#\n");  // 0, 3, 1 of 3
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 4, 0, 0, str({0, 0x0f, 0x80})}.file(), "a.png")), "#.?\n");
  // 16 bits keep their last ones: 22937/65535 is wall, 22938 is not; both have the upper byte 0x59.
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 16, 0, 0, str({0, 0x59, 0x99, 0x59, 0x9a, 255, 255})}.file(), "a.png")),
            "#?.\n");
  // Filter "Sub": each sample is the difference to its left neighbour.
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 8, 0, 0, str({1, 0, 255, 129})}.file(), "a.png")), "#.?\n");
}

TEST(PlanImage, ColourPngIsTheMeanOfItsChannels) {
  // (255, 0, 0): mean 85, p = 0.667; (255, 20, 0): mean 91.7, p = 0.64; white.
  const string rgb = str({0, 255, 0, 0, 255, 20, 0, 255, 255, 255});
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 8, 2, 0, rgb}.file(), "a.png")), "#?.\n");
  string wide = str({0});
  for (std::size_t i = 1; i < rgb.size(); ++i) wide += string(2, rgb[i]);
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 16, 2, 0, wide}.file(), "a.png")), "#?.\n");
}

TEST(PlanImage, TransparentPngPixelsAreUnknown) {
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 8, 4, 0, str({0, 0, 255, 255, 255, 0, 0})}.file(), "a.png")), "#.?\n");
  EXPECT_EQ(rows_of(load_image(Png{2, 1, 8, 6, 0, str({0, 0, 0, 0, 255, 0, 0, 0, 254})}.file(), "a.png")), "#?\n");
  EXPECT_EQ(rows_of(load_image(Png{2, 1, 16, 4, 0, str({0, 0, 0, 255, 255, 0, 0, 255, 254})}.file(), "a.png")), "#?\n");
  // tRNS: the grey 0, the colour (0, 0, 1), the palette's entry 1.
  EXPECT_EQ(rows_of(load_image(Png{2, 1, 8, 0, 0, str({0, 0, 255}), "", str({0, 0})}.file(), "a.png")), "?.\n");
  EXPECT_EQ(
      rows_of(load_image(Png{2, 1, 8, 2, 0, str({0, 0, 0, 1, 0, 0, 0}), "", str({0, 0, 0, 0, 0, 1})}.file(), "a.png")),
      "?#\n");
  const string palette = str({0, 0, 0, 10, 10, 10, 255, 255, 255});
  EXPECT_EQ(rows_of(load_image(Png{3, 1, 8, 3, 0, str({0, 0, 1, 2}), palette, str({255, 0})}.file(), "a.png")),
            "#?.\n");
}

TEST(PlanImage, PalettePng) {
  const string palette = str({255, 255, 255, 0, 0, 0, 128, 128, 128});
  EXPECT_EQ(rows_of(load_image(Png{3, 2, 8, 3, 0, str({0, 1, 0, 2, 0, 1, 1, 1}), palette}.file(), "a.png")), kRows);
  EXPECT_EQ(rows_of(load_image(Png{3, 2, 2, 3, 0, str({0, 0x48, 0, 0x54}), palette}.file(), "a.png")), kRows);
  EXPECT_EQ(rows_of(load_image(Png{2, 1, 1, 3, 0, str({0, 0x80}), palette.substr(0, 6)}.file(), "a.png")), "#.\n");
}

TEST(PlanImage, InterlacedPng) {
  // Adam7 of 3 × 2: pass 1 has (0,0); pass 4 (2,0); pass 6 (1,0); pass 7 the lower row.
  const string passes = str({0, 0, /*4*/ 0, 128, /*6*/ 0, 255, /*7*/ 0, 0, 0, 0});
  EXPECT_EQ(rows_of(load_image(Png{3, 2, 8, 0, 1, passes}.file(), "a.png")), kRows);
}

TEST(PlanImage, Bmp24BottomUpAndTopDown) {
  const string black = str({0, 0, 0}), white = str({255, 255, 255}), grey = str({128, 128, 128}), pad(3, '\x55');
  const string upper = black + white + grey + pad, lower = black + black + black + pad;
  EXPECT_EQ(rows_of(load_image(Bmp{3, 2, 24, lower + upper}.file(), "a.bmp")), kRows);
  EXPECT_EQ(rows_of(load_image(Bmp{3, -2, 24, upper + lower}.file(), "a.bmp")), kRows);
  EXPECT_EQ(rows_of(load_image(Bmp{.width = 3, .height = 2, .bits = 24, .pixels = lower + upper, .header = 12}.file(),
                               "a.bmp")),
            kRows);
  EXPECT_EQ(rows_of(load_image(Bmp{.width = 3, .height = 2, .bits = 24, .pixels = lower + upper, .header = 124}.file(),
                               "a.bmp")),
            kRows);
}

TEST(PlanImage, PaletteBmp) {
  const string white = str({255, 255, 255, 0}), black = str({0, 0, 0, 0}), grey = str({128, 128, 128, 0});
  const string palette = white + black + grey;
  EXPECT_EQ(rows_of(load_image(Bmp{3, 2, 8, str({1, 1, 1, 9, 1, 0, 2, 9}), palette}.file(), "a.bmp")), kRows);
  EXPECT_EQ(rows_of(load_image(Bmp{3, 2, 4, str({0x11, 0x10, 0, 0, 0x10, 0x20, 0, 0}), palette}.file(), "a.bmp")),
            kRows);
  EXPECT_EQ(rows_of(load_image(Bmp{3, 1, 1, str({0xa0, 0, 0, 0}), white + black}.file(), "a.bmp")), "#.#\n");
  EXPECT_EQ(rows_of(load_image(Bmp{.width = 3,
                                   .height = 2,
                                   .bits = 8,
                                   .pixels = str({1, 1, 1, 9, 1, 0, 2, 9}),
                                   .palette = palette,
                                   .header = 108}
                                   .file(),
                               "a.bmp")),
            kRows);
  EXPECT_EQ(refusal(Bmp{1, 1, 8, str({3, 0, 0, 0}), palette}.file(), "a.bmp", {.resolution_m = 1}),
            "a.bmp: pixels: colour 3 is not in the palette");
}

TEST(PlanImage, MaskedBmp) {
  // 32 bits without masks: the fourth byte means nothing.
  EXPECT_EQ(rows_of(load_image(Bmp{2, 1, 32, str({0, 0, 0, 0, 255, 255, 255, 0})}.file(), "a.bmp")), "#.\n");
  // With an alpha mask it does.
  const Bmp v4{.width = 2,
               .height = 1,
               .bits = 32,
               .pixels = str({0, 0, 0, 0, 0, 0, 0, 255}),
               .masks = {0xff0000, 0xff00, 0xff, 0xff000000},
               .compression = 3,
               .header = 108};
  EXPECT_EQ(rows_of(load_image(v4.file(), "a.bmp")), "?#\n");
  // 5-6-5: white is 0xffff; 0x07e0 is pure green, mean 85: wall.
  const Bmp v16{.width = 2,
                .height = 1,
                .bits = 16,
                .pixels = str({0xff, 0xff, 0xe0, 0x07}),
                .masks = {0xf800, 0x07e0, 0x001f, 0},
                .compression = 3};
  EXPECT_EQ(rows_of(load_image(v16.file(), "a.bmp")), ".#\n");
  // 5-5-5 by default: bit 15 means nothing.
  EXPECT_EQ(rows_of(load_image(Bmp{2, 1, 16, str({0xff, 0x7f, 0, 0x80})}.file(), "a.bmp")), ".#\n");
}

}  // namespace
}  // namespace evigrid::scenes
