// SPDX-License-Identifier: Apache-2.0
// Maps that earlier programs saved stay readable, to the bit. Each version has a folder of files that are never made
// anew; its make.sh says how they came to be. (Version 1: golden_map.hpp, io_test.cpp.)
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "evigrid/io.hpp"

namespace evigrid {
namespace {

std::string hex(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

TEST(MapsOfEarlierVersions, OfVersionTwoAreReadToTheBit) {
  const std::string folder = EVIGRID_SOURCE_DIR "/tests/unit/maps_v2/";
  std::ifstream list(folder + "expected.txt");
  std::string file, rule, hash;
  std::size_t tiles = 0, sensors = 0;
  int maps = 0;
  for (; list >> file >> rule >> tiles >> sensors >> hash; ++maps) {
    const MapFileInfo info = inspect(folder + file);
    EXPECT_EQ(info.format_version, 2U) << file;
    EXPECT_EQ(info.maths_version, 2) << file;
    EXPECT_EQ(hex(info.hash), hash) << file;
    Map map = load(folder + file);
    EXPECT_EQ(name(map.params().rule), rule);
    EXPECT_EQ(map.tiles(), tiles) << file;
    EXPECT_EQ(map.sensors().size(), sensors) << file;
    EXPECT_EQ(hex(map.hash()), hash) << file;  // version 3 reads none of these otherwise
    if (file == "forgets.evigrid") {
      EXPECT_EQ(map.params().decay_s, 20);
    }
    if (file == "history.evigrid") {
      EXPECT_TRUE(map.params().keep_con && map.params().keep_last_conflict);
    }
    if (file == "bayes.evigrid") {
      EXPECT_EQ(map.params().bayes.most_p, 0.98);
    }
    const float range_m = 1;
    const Reading reading{0, {&range_m, 1}};
    EXPECT_EQ(map.integrate(Scan{*info.last_stamp_ns - 1, {}, {&reading, 1}}).stamps_backwards, 1U) << file;
  }
  EXPECT_EQ(maps, 8);
}

}  // namespace
}  // namespace evigrid
