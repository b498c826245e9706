// SPDX-License-Identifier: Apache-2.0
// A small saved map, made by the program.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {

/// The map of a short drive, and its folder.
inline std::string mapped_drive(const TempDir& dir, std::vector<std::string> more = {}) {
  std::string log;
  for (int i = 0; i < 5; ++i) log += flaser(180, fmt::format("{}", 3 + 0.2 * i), i, fmt::format("{} 2 0.5", 0.4 * i));
  std::vector<std::string> all{"map", dir.write("a.log", log), "-o", dir.at("out"), "--cell", "0.1"};
  all.insert(all.end(), more.begin(), more.end());
  const Ran ran = evigrid(all);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return dir.at("out");
}

}  // namespace evigrid::driver
