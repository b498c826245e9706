// SPDX-License-Identifier: Apache-2.0
// masses.npy, map.pgm and map.yaml, byte for byte where other programs read them.
#include <gtest/gtest.h>

#include "error.hpp"
#include "out/layers.hpp"
#include "text.hpp"

namespace evigrid::driver {
namespace {

/// 3 wide, 2 high: row 0 (smallest y) empty, occupied, unknown; row 1 all undecided.
Layers small() {
  Layers l;
  l.rect = {-4, 2, 3, 2};
  l.cell_m = 0.5;
  l.planes = {0.9F,      0,    0, 0, 0,     0.5F, /**/ 0, 0.9F, 0, 0, 0.25F, 0.5F,
              /**/ 0.1F, 0.1F, 1, 1, 0.75F, 0,    /**/ 0, 0,    0, 0, 0,     2};
  return l;
}

TEST(Npy, HeadIsVersionOneAlignedAndTells) {
  const std::string head = npy_head(small());
  EXPECT_EQ(head.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(head.size() % 64, 0u);
  EXPECT_EQ(static_cast<unsigned char>(head[8]) + 256u * static_cast<unsigned char>(head[9]), head.size() - 10);
  EXPECT_EQ(head.back(), '\n');
  EXPECT_TRUE(contains(head, "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 2, 3), }"));
}

TEST(Pgm, TrinaryWithTheLargestYOnTop) {
  const std::string image = pgm(small());
  ASSERT_TRUE(starts_with(image, "P5\n"));
  const std::string pixels = image.substr(image.size() - 6);
  const std::string wanted{static_cast<char>(205), static_cast<char>(205), static_cast<char>(205),
                           static_cast<char>(254), static_cast<char>(0),   static_cast<char>(205)};
  EXPECT_EQ(pixels, wanted);
  EXPECT_TRUE(contains(image, "\n3 2\n255\n"));
}

TEST(Yaml, OriginIsTheLowerLeftCorner) {
  EXPECT_EQ(map_yaml(small(), "map.pgm"),
            "image: map.pgm\nmode: trinary\nresolution: 0.5\norigin: [-2, 1, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(Dense, TooLargeIsRefusedByName) {
  require_dense_fits({0, 0, 1000, 1000}, 20);
  try {
    require_dense_fits({0, 0, 4'000'000'000, 4'000'000'000}, 2048);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "masses.npy"));
    EXPECT_TRUE(contains(error.what(), "--max-image-mb 2048"));
  }
}

TEST(Dense, PlanesAreTheMapsFloats) {
  Map map({.cell_m = 0.1}, make_serial_executor());
  Sensor sonar;
  const SensorId id = map.add(sonar);
  const float range_m = 2;
  const Reading reading{id, {&range_m, 1}};
  map.integrate(Scan{0, {0.05, 0.05, 0.3}, {&reading, 1}});
  const Layers l = render_layers(map, 100);
  ASSERT_FALSE(l.rect.empty());
  for (std::int64_t y = 0; y < l.rect.height; ++y) {
    for (std::int64_t x = 0; x < l.rect.width; ++x) {
      const CellIndex cell{l.rect.x + x, l.rect.y + y};
      const auto i = static_cast<std::size_t>(y * l.rect.width + x);
      EXPECT_EQ(map.mass(cell), (Mass{l.e()[i], l.o()[i], l.u()[i]}));
      EXPECT_EQ(map.conflict(cell), l.conflict()[i]);
    }
  }
}

}  // namespace
}  // namespace evigrid::driver
