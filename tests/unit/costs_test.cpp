// SPDX-License-Identifier: Apache-2.0
// Rendered costs against those of the cells one by one: every kernel, every rule of maps, rectangles that begin and end
// anywhere, thresholds that lie on masses.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

/// Cones all about, seen from a few places, some of them contradicting: costs of every kind.
Map seen(Rule rule, Kernel kernel) {
  MapParams p;
  p.rule = rule;
  p.kernel = kernel;
  Map map(p, make_serial_executor());
  std::vector<SensorId> ids;
  for (int i = 0; i < 12; ++i) {
    Sensor s;
    s.aperture_rad = 0.4;
    s.T_robot_sensor = {0.1, 0, 0.52 * i};
    ids.push_back(map.add(s));
  }
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> range(0.4f, 3.0f);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (int scan = 0; scan < 6; ++scan) {
    const Pose2 pose{place(engine), place(engine), place(engine)};
    std::vector<float> ranges;
    for (std::size_t i = 0; i < ids.size(); ++i) ranges.push_back(range(engine));
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < ids.size(); ++i) readings.push_back({ids[i], {&ranges[i], 1}});
    map.integrate(Scan{scan, pose, readings});
  }
  return map;
}

void expect_costs_of_cells(const Map& map, const Costmap& c, const CellRect& rect, std::size_t (&kinds)[4]) {
  const std::ptrdiff_t stride = rect.width + 3;
  std::vector<std::int8_t> grid(static_cast<std::size_t>(stride * rect.height), 77);
  std::vector<std::uint8_t> costs(grid.size(), 77);
  map.render(c, rect, grid, stride);
  map.render(c, rect, costs, stride);
  for (std::int64_t y = 0; y < rect.height; ++y) {
    for (std::int64_t x = 0; x < stride; ++x) {
      const auto i = static_cast<std::size_t>(y * stride + x);
      const bool inside = x < rect.width;
      const Mass m = inside ? map.mass({rect.x + x, rect.y + y}) : Mass{};
      ASSERT_EQ(grid[i], inside ? occupancy_of(c, m) : 77) << x << ' ' << y;
      ASSERT_EQ(costs[i], inside ? cost_of(c, m) : 77) << x << ' ' << y;
      if (inside) ++kinds[costs[i] == 0 ? 0 : costs[i] == 254 ? 1 : costs[i] == 255 ? 2 : 3];
    }
  }
}

class CostsOfEveryRule : public testing::TestWithParam<Rule> {};

TEST_P(CostsOfEveryRule, AreThoseOfTheCells) {
  for (const Kernel kernel : {Kernel::scalar, Kernel::avx2, Kernel::avx512}) {
    if (!kernel_available(kernel)) continue;
    SCOPED_TRACE(std::string(name(kernel)));
    const Map map = seen(GetParam(), kernel);
    const Mass m = map.mass({12, 9});  // a threshold that lies on a cell
    const double betp = static_cast<double>(m.o) + 0.5 * static_cast<double>(m.u);
    std::size_t kinds[4] = {};
    for (const Costmap& c :
         {Costmap{}, Costmap{.free_below = 0.3, .lethal_above = 0.300001}, Costmap{.max_unknown = 0.4},
          Costmap{.free_below = betp > 0 && betp < 0.9 ? betp : 0.1, .lethal_above = 0.9}}) {
      expect_costs_of_cells(map, c, {-90, -85, 170, 160}, kinds);
    }
    std::mt19937 engine(11);
    std::uniform_int_distribution<std::int64_t> from(-70, 40), size(1, 40);
    for (int i = 0; i < 40; ++i)
      expect_costs_of_cells(map, Costmap{}, {from(engine), from(engine), size(engine), size(engine)}, kinds);
    for (const std::size_t n : kinds) EXPECT_GT(n, 100u);
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, CostsOfEveryRule, testing::ValuesIn(map_rules().begin(), map_rules().end()),
                         [](const auto& rule) {
                           std::string word(name(rule.param));
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

TEST(Costs, ACellThatHoldsNothingButParadoxIsHalfOfEither) {
  const Mass m{0, 0, 0, 1};
  EXPECT_EQ(occupancy_of({}, m), occupancy_of({}, Mass{0.5f, 0.5f, 0, 0}));
  EXPECT_EQ(cost_of({}, m), cost_of({}, Mass{0.5f, 0.5f, 0, 0}));
}

}  // namespace
}  // namespace evigrid
