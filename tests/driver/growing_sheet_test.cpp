// SPDX-License-Identifier: Apache-2.0
// Pictures of maps that are gone are those that would be drawn of all of them together.
#include <gtest/gtest.h>

#include <set>

#include "picture/growing_sheet.hpp"

namespace evigrid::driver {
namespace {

/// Never twice the same cell beside itself.
Layers map_of(const CellRect& rect, float seed) {
  Layers l;
  l.rect = rect;
  l.cell_m = 0.1;
  const std::size_t n = l.cells();
  l.planes.assign(4 * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const float o = static_cast<float>(i * 7919 % 1000) / 2000, e = seed * (0.5F - o);
    l.planes[i] = e, l.planes[n + i] = o, l.planes[2 * n + i] = 1 - e - o;
  }
  return l;
}

bool same(const Thumbnail& a, const Thumbnail& b) {
  return a.width == b.width && a.height == b.height && a.pixels == b.pixels;
}

TEST(GrowingSheet, PicturesAreThoseAtTheScaleOfTheWhole) {
  const std::vector<Layers> maps{map_of({0, 0, 90, 40}, 0.3F), map_of({-35, 10, 60, 70}, 0.5F), map_of({}, 0),
                                 map_of({5, 5, 20, 20}, 0.7F), map_of({-35, -1, 125, 81}, 0.9F)};
  for (const int panel_px : {50, 400}) {  // several cells a pixel, and the other way round
    GrowingSheet sheet(panel_px);
    for (const Layers& map : maps) sheet.add(map);
    std::set<std::size_t> again;
    const auto pictures = sheet.finish([&](std::size_t i) {
      again.insert(i);
      return maps[i];
    });
    ASSERT_EQ(pictures.size(), maps.size());
    const SheetScale scale = sheet_scale({-35, -1, 125, 81}, panel_px);
    for (std::size_t i = 0; i < maps.size(); ++i) EXPECT_TRUE(same(pictures[i], thumbnail(maps[i], scale))) << i;
    EXPECT_EQ(again, (std::set<std::size_t>{0, 1, 2, 3}));  // the last one saw the whole box
  }
}

TEST(GrowingSheet, WithABoxOfItsOwnNoMapIsAskedForTwice) {
  const CellRect world{0, 0, 50, 50};
  const std::vector<Layers> maps{map_of({-10, -10, 90, 40}, 0.3F), map_of({20, 20, 60, 70}, 0.5F)};
  GrowingSheet sheet(25, world);
  for (const Layers& map : maps) sheet.add(map);
  const auto pictures = sheet.finish([&](std::size_t i) {
    ADD_FAILURE() << i;
    return maps[i];
  });
  for (std::size_t i = 0; i < maps.size(); ++i)
    EXPECT_TRUE(same(pictures[i], thumbnail(maps[i], sheet_scale(world, 25))));
}

}  // namespace
}  // namespace evigrid::driver
