// SPDX-License-Identifier: Apache-2.0
// A map as a slab of voxels: read back by OctoMap itself.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include "evigrid/evigrid.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

TEST(Octomap, VoxelsAreTheCells) {
  const TempDir dir;
  Map map({.cell_m = 0.1});
  const Mass occupied{0, 0.9F, 0.1F}, empty{0.8F, 0.1F, 0.1F}, unsure{0.3F, 0.3F, 0.4F};
  std::vector<Mass> cells;
  for (int i = 0; i < 70 * 5; ++i) cells.push_back(i % 3 == 0 ? occupied : i % 3 == 1 ? empty : unsure);
  map.write({-66, -2, 70, 5}, cells, 70);
  save(map, dir.at("m.evigrid"));
  const Ran ran = evigrid({"export", dir.at("m.evigrid"), "-o", dir.at("m.bt"), "--slab", "-0.2,0.5"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  octomap::OcTree tree(dir.at("m.bt"));
  EXPECT_NEAR(tree.getResolution(), 0.1, 1e-12);
  for (int iy = -5; iy < 6; ++iy) {
    for (int ix = -70; ix < 8; ++ix) {
      for (int iz = -4; iz < 8; ++iz) {
        const auto* node = tree.search(0.1 * ix + 0.05, 0.1 * iy + 0.05, 0.1 * iz + 0.05);
        const bool inside = ix >= -66 && ix < 4 && iy >= -2 && iy < 3 && iz >= -2 && iz < 5;
        const int kind = inside ? ((iy + 2) * 70 + ix + 66) % 3 : 2;
        ASSERT_EQ(node != nullptr, kind != 2) << ix << ' ' << iy << ' ' << iz;
        if (node == nullptr) continue;
        ASSERT_EQ(tree.isNodeOccupied(node), kind == 0) << ix << ' ' << iy;
      }
    }
  }
  EXPECT_EQ(evigrid({"export", dir.at("m.evigrid"), "-o", dir.at("x.bt"), "--slab", "1,0"}).code, 2);
}

TEST(Octomap, BeyondAnOctreeIsAnError) {
  const TempDir dir;
  Map map({.cell_m = 0.1});
  const std::vector<Mass> one{{0, 0.9F, 0.1F}};
  map.write({32768, 0, 1, 1}, one, 1);
  save(map, dir.at("m.evigrid"));
  const Ran ran = evigrid({"export", dir.at("m.evigrid"), "-o", dir.at("m.bt")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(contains(ran.err, "an octree of 0.1 m voxels ends at 3276.8 m")) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(dir.at("m.bt")));
}

}  // namespace
}  // namespace evigrid::driver
