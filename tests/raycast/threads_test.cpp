// SPDX-License-Identifier: Apache-2.0
// Answers do not depend on who asks, how many ask at once, or in which order: compared bit by bit.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <thread>
#include <vector>

#include "both_indices.hpp"
#include "evigrid/raycast/scene.hpp"
#include "random_world.hpp"

namespace evigrid::raycast {
namespace {

using testing::BothIndices;

TEST(Threads, SameBitsFromManyThreads) {
  testing::Random r(11);
  const World world = testing::random_room(r);
  const BothIndices scene(world), again(world);
  std::vector<ConeQuery> queries;
  for (int i = 0; i < 2000; ++i) queries.push_back(testing::random_cone(r));
  std::vector<double> alone;
  for (const ConeQuery& q : queries) alone.push_back(scene.cast_cone(q).range_m);
  std::atomic<int> different = 0;
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 7; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t k = 0; k < queries.size(); ++k) {
          const std::size_t i = (k * (2 * t + 1) + 131 * t) % queries.size();  // each in its own order
          const double got = (t % 2 ? scene : again).cast_cone(queries[i]).range_m;
          different += std::memcmp(&got, &alone[i], sizeof got) != 0;
        }
      });
  }
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace evigrid::raycast
