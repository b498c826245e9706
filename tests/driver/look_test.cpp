// SPDX-License-Identifier: Apache-2.0
// Looks: their numbers, their colours in the picture, the colour bar, and the map in a terminal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "driver/decoded_png.hpp"
#include "driver/text.hpp"
#include "error.hpp"
#include "picture/map_picture.hpp"
#include "picture/terminal.hpp"

namespace evigrid::driver {
namespace {

double luminance(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// Five cells: empty, occupied, never seen, contested, half known.
Layers five() {
  Layers l;
  l.rect = {-2, 3, 5, 1};
  l.cell_m = 0.5;
  l.planes = {1, 0, 0, 0.5F, 0.2F, /**/ 0, 1, 0, 0.5F, 0.4F, /**/ 0, 0, 1, 0, 0.4F, /**/ 0.1F, 0, 0, 7, 0};
  return l;
}

TEST(Ramp, EndsAndMiddlesAreThePublishedOnes) {
  EXPECT_EQ(colour_of(Ramp::viridis, 0), (Rgb{0x44, 0x01, 0x54}));
  EXPECT_EQ(colour_of(Ramp::viridis, 0.5), (Rgb{0x21, 0x91, 0x8c}));
  EXPECT_EQ(colour_of(Ramp::viridis, 1), (Rgb{0xfd, 0xe7, 0x25}));
  EXPECT_EQ(colour_of(Ramp::rdbu, 0.5), (Rgb{0xf7, 0xf7, 0xf7}));
  EXPECT_EQ(colour_of(Ramp::greys, 1), (Rgb{0, 0, 0}));
  EXPECT_EQ(colour_of(Ramp::viridis, NAN), colour_of(Ramp::viridis, 0));
  EXPECT_EQ(colour_of(Ramp::viridis, 9), colour_of(Ramp::viridis, 1));
}

TEST(Ramp, LightnessOnlyRisesOrOnlyFalls) {
  for (int i = 0; i < 100; ++i) {
    const double a = i / 100.0, b = (i + 1) / 100.0;
    EXPECT_LT(luminance(colour_of(Ramp::viridis, a)), luminance(colour_of(Ramp::viridis, b)) + 1) << i;
    EXPECT_GT(luminance(colour_of(Ramp::oranges, a)) + 1, luminance(colour_of(Ramp::oranges, b))) << i;
    const double side = luminance(colour_of(Ramp::rdbu, a)) - luminance(colour_of(Ramp::rdbu, b));
    EXPECT_TRUE(i < 50 ? side < 1 : side > -1) << i;
  }
}

TEST(Look, Numbers) {
  const Layers l = five();
  const auto at = [&](Look look, std::size_t i) { return value_of(look, l, i); };
  EXPECT_NEAR(at(Look::betp, 4), 0.6, 1e-7);
  EXPECT_NEAR(at(Look::bel, 4), 0.4, 1e-7);
  EXPECT_NEAR(at(Look::pl, 4), 0.8, 1e-7);
  EXPECT_NEAR(at(Look::empty, 4), 0.2, 1e-7);
  EXPECT_NEAR(at(Look::ignorance, 4), at(Look::pl, 4) - at(Look::bel, 4), 1e-7);
  EXPECT_NEAR(at(Look::entropy, 4), 0.9709505944546686, 1e-6);  // of 0.6 and 0.4
  EXPECT_EQ(at(Look::entropy, 0), 0);
  EXPECT_EQ(at(Look::entropy, 2), 1);
  EXPECT_EQ(at(Look::conflict, 3), 7);
  EXPECT_EQ(at(Look::costmap, 1), 254);
  EXPECT_TRUE(never_seen(l, 2));
  EXPECT_FALSE(never_seen(l, 4));
  EXPECT_EQ(top_of(Look::betp, l), 1);
  EXPECT_EQ(top_of(Look::conflict, l), 10);
}

TEST(Look, NamesAreReadAndBadOnesNamed) {
  EXPECT_EQ(parse_looks("--layers", "betp,conflict,betp"), (std::vector{Look::betp, Look::conflict}));
  EXPECT_EQ(parse_looks("--layers", "all").size(), all_looks().size());
  EXPECT_TRUE(parse_looks("--layers", "").empty());
  for (const char* bad : {"betp,", ",", "BETP", "nothing"}) {
    try {
      parse_looks("--layers", bad);
      ADD_FAILURE() << bad;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), "--layers: '"));
      EXPECT_TRUE(contains(error.what(), "known: betp, bel"));
    }
  }
}

TEST(Look, EveryLookIsAPictureWithItsCellsInTheirColours) {
  const Layers l = five();
  for (const LookRow& row : all_looks()) {
    const auto bytes = png(draw(row.look, l, {{-0.9, 1.6, 0}, {1.4, 1.6, 0}}, {"title", "subtitle"}));
    const DecodedPng image = decode_png(bytes.data(), bytes.size());
    ASSERT_GT(image.width, 500) << row.name;
    if (!row.ramp) continue;
    const int cell = 180, left = (image.width - 5 * cell - kColourBar_px - 12) / 2;  // 5 cells are enlarged to 900
    for (std::size_t i = 0; i < 5; ++i) {
      const Rgb seen = image.get(left + static_cast<int>(i) * cell + 90, 52 + 20);
      if (i == 2) {
        EXPECT_EQ(seen, kNeverSeen) << row.name;
      } else if (!(row.look == Look::costmap && i == 1)) {
        EXPECT_EQ(seen, colour_of(*row.ramp, value_of(row.look, l, i) / top_of(row.look, l))) << row.name << i;
      }
    }
    const int bar_x = left + 5 * cell + 12 + 5;  // low end below, high end above
    EXPECT_EQ(image.get(bar_x, 52 + 28 + 1), colour_of(*row.ramp, 1 - 1.5 / 150)) << row.name;
    EXPECT_EQ(image.get(bar_x, 52 + 28 + 148), colour_of(*row.ramp, 1.5 / 150)) << row.name;
  }
}

TEST(Composite, GreyOfTheThreeMasses) {
  EXPECT_EQ(composite_grey(1, 0, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(composite_grey(0, 1, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(composite_grey(0, 0, 1), (Rgb{128, 128, 128}));
  EXPECT_EQ(composite_grey(0.25F, 0.75F, 0), (Rgb{64, 64, 64}));
}

TEST(Panels, DarkerIsSurer) {
  Layers l;
  l.rect = {0, 0, 1, 1};
  l.cell_m = 1;
  l.planes = {0.8F, 0, 0.2F, 0};
  const Canvas c = draw_panels(l, {}, {"", ""});
  const int panel = 480, step = panel + 16, x = 16 + panel / 2, y = 52 + 26 + panel / 2;
  EXPECT_EQ(c.get(x, y), (Rgb{51, 51, 51}));                // m(empty) .8
  EXPECT_EQ(c.get(x + step, y), (Rgb{255, 255, 255}));      // m(occupied) 0
  EXPECT_EQ(c.get(x + 2 * step, y), (Rgb{204, 204, 204}));  // m(unknown) .2
  EXPECT_EQ(c.get(x + 3 * step, y), composite_grey(0.8F, 0, 0.2F));
}

TEST(Surface, ATowerStandsOutAndHidesWhatIsBehindIt) {
  Layers l;
  l.rect = {0, 0, 60, 60};
  l.cell_m = 0.1;
  l.planes.assign(4 * 3600, 0);
  for (std::size_t i = 0; i < 3600; ++i) l.planes[i] = 1;  // all empty
  const Canvas flat = draw_surface(l, {"", ""});
  for (std::size_t y = 20; y < 30; ++y) {
    for (std::size_t x = 20; x < 30; ++x) {
      l.planes[y * 60 + x] = 0;
      l.planes[3600 + y * 60 + x] = 1;
    }
  }
  const Canvas tower = draw_surface(l, {"", ""});
  ASSERT_EQ(flat.width(), tower.width());
  ASSERT_EQ(flat.height(), tower.height());
  int yellow = 0, changed = 0;
  for (int y = 200; y < tower.height(); ++y) {
    for (int x = 0; x < tower.width() - 120; ++x) {
      const Rgb c = tower.get(x, y);
      yellow += c == colour_of(Ramp::viridis, 1);
      changed += !(c == flat.get(x, y));
    }
  }
  // The roof is a parallelogram of 9 × 9 cells between the outermost full vertices, seen from 38° above: a cell of the
  // projected ground has 980/60/(cos 35° + sin 35°) pixels a side and sin 38° of its area.
  const double side_px = 980.0 / 60 / (std::cos(35 * M_PI / 180) + std::sin(35 * M_PI / 180));
  const double roof = 81 * side_px * side_px * std::sin(38 * M_PI / 180);
  EXPECT_NEAR(yellow, roof, 0.05 * roof);
  EXPECT_GT(changed, 1.5 * roof);  // and it has sides
}

TEST(Surface, AnySizeIsDrawn) {
  for (const CellRect rect : {CellRect{0, 0, 1, 1}, {5, -5, 1, 300}, {-1000, 0, 900, 2}}) {
    Layers l;
    l.rect = rect;
    l.cell_m = 0.05;
    l.planes.assign(4 * l.cells(), 0.25F);
    EXPECT_EQ(draw_surface(l, {"", ""}).width(), 1200);
  }
}

TEST(Coarse, WallsStayAndTheRestIsTheMean) {
  Layers l;
  l.rect = {0, 0, 4, 2};
  l.cell_m = 0.5;
  l.planes = {1, 1, 0, 1, /**/ 1, 0,    0, 0, /**/ 0, 0, 0, 0, /**/ 0, 0.9F, 0, 0,
              0, 0, 1, 0, /**/ 0, 0.1F, 1, 1, /**/ 0, 0, 0, 0, 0,      3,    0, 0};
  const Layers c = coarse(l, 2);
  EXPECT_EQ(c.rect, (CellRect{0, 0, 2, 1}));
  EXPECT_EQ(c.cell_m, 1);
  EXPECT_EQ(c.o()[0], 0.9F);
  EXPECT_EQ(c.u()[0], 0.1F);
  EXPECT_EQ(c.conflict()[0], 3);
  EXPECT_EQ(c.e()[1], 0.25F);
  EXPECT_EQ(c.u()[1], 0.75F);
}

TEST(Terminal, LettersWithoutColour) {
  const std::string text = terminal_picture(Look::mixed, five(), 80, false);
  EXPECT_TRUE(starts_with(text, ".# ?:\n"));
  EXPECT_TRUE(contains(text, "# occupied"));
  EXPECT_TRUE(contains(text, "x -1.00 to 1.50 m, y 1.50 to 2.00 m"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_TRUE(starts_with(terminal_picture(Look::bel, five(), 80, false), ".@ +=\n"));
  EXPECT_THROW(terminal_picture(Look::surface, five(), 80, false), InputError);
}

TEST(Terminal, HalfBlocksOfTwoRowsEach) {
  Layers l;
  l.rect = {0, 0, 1, 2};
  l.cell_m = 1;
  l.planes = {1, 0, /**/ 0, 1, /**/ 0, 0, /**/ 0, 0};  // below empty, above occupied
  const std::string text = terminal_picture(Look::composite, l, 80, true);
  EXPECT_TRUE(starts_with(text, "\x1b[38;2;0;0;0m\x1b[48;2;255;255;255m\u2580\x1b[0m\n"));
}

TEST(Terminal, NeverWiderThanItsColumns) {
  Layers l;
  l.rect = {0, 0, 1001, 7};
  l.cell_m = 1;
  l.planes.assign(4 * l.cells(), 0.25F);
  const std::string text = terminal_picture(Look::mixed, l, 50, false);
  EXPECT_LE(text.find('\n'), 50u);
  EXPECT_GE(text.find('\n'), 45u);
}

}  // namespace
}  // namespace evigrid::driver
