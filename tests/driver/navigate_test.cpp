// SPDX-License-Identifier: Apache-2.0
// The planner: against a plain Dijkstra and against the optimal lengths published with the MovingAI grid maps (skipped
// by name where those are absent); the distance transform against brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <queue>
#include <random>
#include <sstream>

#include "navigate/astar.hpp"
#include "navigate/distance_transform.hpp"

namespace {

using namespace evigrid::driver;

CostGrid random_grid(int w, int h, unsigned seed, double walls) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  CostGrid grid(w, h);
  for (float& c : grid.cost)
    c = unit(engine) < walls ? kBlocked : static_cast<float>(1 + 9 * unit(engine) * unit(engine));
  return grid;
}

/// Every distance from `start`, by the definition of a step.
std::vector<double> dijkstra(const CostGrid& grid, GridCell start) {
  std::vector<double> best(grid.cost.size(), INFINITY);
  using Item = std::pair<double, std::size_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  best[grid.index(start)] = 0;
  open.push({0, grid.index(start)});
  while (!open.empty()) {
    const auto [g, i] = open.top();
    open.pop();
    if (g > best[i]) continue;
    const GridCell at = grid.cell(i);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const GridCell to{at.x + dx, at.y + dy};
        if ((dx == 0 && dy == 0) || !grid.free(to)) continue;
        if (dx != 0 && dy != 0 && (!grid.free({at.x + dx, at.y}) || !grid.free({at.x, at.y + dy}))) continue;
        const double next = g + std::hypot(dx, dy) * static_cast<double>(grid.cost[grid.index(to)]);
        if (next < best[grid.index(to)]) open.push({best[grid.index(to)] = next, grid.index(to)});
      }
  }
  return best;
}

TEST(Planner, FindsTheCheapestWay) {
  Planner planner;
  int found = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const CostGrid grid = random_grid(23 + static_cast<int>(seed % 9), 31, seed, 0.3);
    std::mt19937 engine(seed);
    const auto any = [&] {
      return GridCell{static_cast<int>(engine() % static_cast<unsigned>(grid.width)),
                      static_cast<int>(engine() % static_cast<unsigned>(grid.height))};
    };
    const GridCell start = any();
    if (!grid.free(start)) continue;
    const auto best = dijkstra(grid, start);
    for (int n = 0; n < 20; ++n) {
      const GridCell goal = any();
      const GridPath path = planner.find(grid, start, goal);
      const double want = best[grid.index(goal)];
      ASSERT_EQ(path.found(), want < INFINITY);
      if (!path.found()) continue;
      ++found;
      ASSERT_NEAR(path.cost, want, 1e-9 * (1 + want));
      EXPECT_EQ(path.cells.front(), start);
      EXPECT_EQ(path.cells.back(), goal);
      double cost = 0, length = 0;
      for (std::size_t i = 1; i < path.cells.size(); ++i) {
        const GridCell a = path.cells[i - 1], b = path.cells[i];
        ASSERT_TRUE(grid.free(b) && grid.free({a.x, b.y}) && grid.free({b.x, a.y}));
        length += std::hypot(b.x - a.x, b.y - a.y);
        cost += std::hypot(b.x - a.x, b.y - a.y) * static_cast<double>(grid.cost[grid.index(b)]);
      }
      ASSERT_NEAR(cost, path.cost, 1e-9 * (1 + want));
      ASSERT_NEAR(length, path.length, 1e-9 * (1 + want));
    }
  }
  EXPECT_GT(found, 200);
}

TEST(OpenList, GivesItemsInTheOrderOfOneHeap) {
  // Pushes as a search makes them: never below what was taken last, some far beyond the ring of buckets.
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto later = [](const OpenList::Item& a, const OpenList::Item& b) {
    return a.f != b.f ? a.f > b.f : a.g != b.g ? a.g < b.g : a.index > b.index;
  };
  OpenList list;
  for (int round = 0; round < 3; ++round) {
    list.clear();  // with items left from the round before
    std::priority_queue<OpenList::Item, std::vector<OpenList::Item>, decltype(later)> want(later);
    double f = 100 * unit(engine);
    std::uint32_t index = 0;
    const auto push = [&](double by) {
      const OpenList::Item item{f + by, std::floor(4 * unit(engine)), index++};
      list.push(item), want.push(item);
    };
    push(0);
    for (int i = 0; i < 20000 && !want.empty(); ++i) {
      ASSERT_FALSE(list.empty());
      const OpenList::Item got = list.pop(), top = want.top();
      want.pop();
      ASSERT_EQ(got.f, top.f);
      ASSERT_EQ(got.g, top.g);
      ASSERT_EQ(got.index, top.index);
      f = got.f;
      const double kind = unit(engine);
      if (i < 15000 || round == 2) {
        push(0);
        if (kind < 0.3) push(unit(engine));
        if (kind < 0.02) push(1000 * unit(engine));
        if (kind < 0.001) push(1e18 * unit(engine));
      }
    }
    EXPECT_EQ(list.empty(), want.empty());
  }
}

TEST(Planner, EdgesOfTheQuestion) {
  Planner planner;
  CostGrid grid(3, 3);
  EXPECT_EQ(planner.find(grid, {1, 1}, {1, 1}).cells.size(), 1u);
  EXPECT_FALSE(planner.find(grid, {1, 1}, {3, 1}).found());
  grid.cost[grid.index({1, 0})] = grid.cost[grid.index({0, 1})] = kBlocked;  // no squeezing between two corners
  EXPECT_FALSE(planner.find(grid, {0, 0}, {1, 1}).found());
  const std::vector<GridCell> path{{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 2}, {4, 3}};
  EXPECT_EQ(corners(path), (std::vector<GridCell>{{0, 0}, {2, 0}, {4, 2}, {4, 3}}));
}

struct Scenario {
  GridCell start, goal;
  double length;
};

/// The map's passable cells ('.', 'G', 'S') and its scenarios; rows are read top down, as both files count them.
bool read_movingai(const std::string& map_path, CostGrid& grid, std::vector<Scenario>& scenarios) {
  std::ifstream map(map_path), scen(map_path + ".scen");
  if (!map || !scen) return false;
  std::string word, line;
  int height = 0, width = 0;
  while (map >> word && word != "map") {
    if (word == "height") map >> height;
    if (word == "width") map >> width;
  }
  grid = CostGrid(width, height, kBlocked);
  for (int y = 0; y < height && map >> line; ++y)
    for (int x = 0; x < width; ++x) {
      const char c = line[static_cast<std::size_t>(x)];
      if (c == '.' || c == 'G' || c == 'S') grid.cost[grid.index({x, y})] = 1;
    }
  std::getline(scen, line);  // version
  while (std::getline(scen, line)) {
    std::istringstream fields(line);
    std::string bucket, name, w, h;
    Scenario s{};
    if (fields >> bucket >> name >> w >> h >> s.start.x >> s.start.y >> s.goal.x >> s.goal.y >> s.length)
      scenarios.push_back(s);
  }
  return true;
}

class MovingAi : public testing::TestWithParam<std::pair<const char*, int>> {};
TEST_P(MovingAi, LengthsAreTheOptimalOnes) {
  const auto [name, every] = GetParam();
  const std::string path = std::string(EVIGRID_DATA_DIR "/movingai/") + name;
  CostGrid grid;
  std::vector<Scenario> scenarios;
  if (!read_movingai(path, grid, scenarios)) GTEST_SKIP() << "missing: " << path;
  ASSERT_GT(scenarios.size(), 10u);
  Planner planner;
  for (std::size_t i = 0; i < scenarios.size(); i += static_cast<std::size_t>(every)) {
    const Scenario& s = scenarios[i];
    const GridPath way = planner.find(grid, s.start, s.goal);
    ASSERT_TRUE(way.found()) << name << " scenario " << i;
    ASSERT_NEAR(way.length, s.length, 2e-4 * s.length + 1e-6) << name << " scenario " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Maps, MovingAi,
                         testing::Values(std::pair{"dao/arena.map", 1}, std::pair{"dao/den312d.map", 1},
                                         std::pair{"small100/maze-100-1.map", 1}, std::pair{"dao/lak303d.map", 11},
                                         std::pair{"dao/den520d.map", 11}, std::pair{"rooms512/32room_000.map", 29},
                                         std::pair{"random512/random512-10-0.map", 17}));

TEST(DistanceTransform, IsExact) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 engine(seed);
    const int w = 1 + static_cast<int>(engine() % 40), h = 1 + static_cast<int>(engine() % 40);
    const unsigned rarity = 2 + seed * 7;
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(w * h));
    for (auto& m : marked) m = engine() % rarity == 0;
    const auto got = squared_distances(marked, w, h);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        std::int64_t want = -1;
        for (int j = 0; j < h; ++j)
          for (int i = 0; i < w; ++i) {
            const std::int64_t d = (i - x) * (i - x) + (j - y) * (j - y);
            if (marked[static_cast<std::size_t>(j * w + i)] && (want < 0 || d < want)) want = d;
          }
        ASSERT_EQ(got[static_cast<std::size_t>(y * w + x)], want) << seed << " (" << x << ", " << y << ")";
      }
  }
}

}  // namespace
