// SPDX-License-Identifier: Apache-2.0
// Plans of other people's making: all are read, and their cells are counted again here by other means (a naive PGM
// reader, characters of octile maps, figures stated by hand for the PNGs).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "evigrid/raycast/scene.hpp"
#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

namespace fs = std::filesystem;

fs::path data(const std::string& name) { return fs::path(EVIGRID_DATA_DIR) / name; }

#define NEEDS(path) \
  if (!fs::exists(path)) GTEST_SKIP() << "missing: " << (path).string()

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// free, occupied, unknown.
std::array<std::int64_t, 3> counts(const FloorPlan& plan) {
  std::array<std::int64_t, 3> n{};
  for (const PlanCell c : plan.cells) ++n[static_cast<std::size_t>(c)];
  return n;
}

TEST(PlanData, RosMaps) {
  struct Case {
    const char *yaml, *pgm;
    double resolution_m, x_m, y_m, yaw_rad, free_threshold;
  };
  for (const Case& c :
       {Case{"ros-nav2/depot.yaml", "ros-nav2/depot.pgm", 0.05, 0, 0, 0, 0.25},
        Case{"ros-turtlebot3/map.yaml", "ros-turtlebot3/map.pgm", 0.05, -10, -10, 0, 0.196},
        Case{"f1tenth/mtl.yaml", "f1tenth/mtl.pgm", 0.05, -12.381815, -10.843172, 0, 0.196},
        Case{"ros-willow/willow-2010-02-18-0.10.yaml", "ros-willow/willow-2010-02-18-0.10.pgm", 0.1, 0, 0, 0, 0.196}}) {
    const fs::path yaml = data(std::string("maps/") + c.yaml), pgm = data(std::string("maps/") + c.pgm);
    NEEDS(yaml);
    const FloorPlan plan = load_plan(yaml);
    EXPECT_EQ(plan.resolution_m, c.resolution_m);
    EXPECT_EQ(plan.origin.x_m, c.x_m);
    EXPECT_EQ(plan.origin.y_m, c.y_m);
    EXPECT_EQ(plan.origin.yaw_rad, c.yaw_rad);
    // All are P5 of 8 bits: the pixels are the file's last bytes, top row first.
    const std::string bytes = slurp(pgm);
    ASSERT_EQ(bytes.substr(0, 2), "P5");
    const std::size_t pixels = plan.cells.size();
    ASSERT_GT(bytes.size(), pixels);
    std::array<std::int64_t, 3> expected{};
    bool same = true;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double p = (255 - static_cast<unsigned char>(bytes[bytes.size() - pixels + i])) / 255.0;
      const int cell = p > 0.65 ? 1 : p < c.free_threshold ? 0 : 2;
      ++expected[static_cast<std::size_t>(cell)];
      const auto x = static_cast<std::int64_t>(i) % plan.width, y = static_cast<std::int64_t>(i) / plan.width;
      same &= static_cast<int>(plan.at(x, plan.height - 1 - y)) == cell;
    }
    EXPECT_TRUE(same) << c.yaml;
    EXPECT_EQ(counts(plan), expected) << c.yaml;
    EXPECT_GT(expected[0], 0);
    EXPECT_GT(expected[1], 0);
  }
}

TEST(PlanData, OnePictureInThreeFormatsWithATurnedOrigin) {
  const fs::path yaml = data("maps/ros-nav2/testmap.yaml");
  NEEDS(yaml);
  const FloorPlan plan = load_plan(yaml);
  EXPECT_EQ(plan.origin.yaw_rad, 1);
  EXPECT_EQ(plan.width, 10);
  const ImageScale scale{.resolution_m = 0.1};
  EXPECT_EQ(rows_of(load_plan(data("maps/ros-nav2/testmap.png"), scale)), rows_of(plan));
  EXPECT_EQ(rows_of(load_plan(data("maps/ros-nav2/testmap.bmp"), scale)), rows_of(plan));
  EXPECT_EQ(rows_of(load_plan(data("maps/ros-nav2/testmap.pgm"), scale)), rows_of(plan));
  EXPECT_GT(counts(plan)[1], 0);
}

TEST(PlanData, Images) {
  struct Case {
    const char* name;
    std::int64_t width, height, free, occupied;
  };
  // Counts of the source's colours by a separate program: black is wall, white (and 254) is free.
  for (const Case& c :
       {Case{"ipa-rooms/Freiburg79_scan.png", 800, 544, 128193, 8866},
        Case{"ipa-rooms/lab_c_scan.png", 800, 544, 142651, 8366},
        Case{"ipa-rooms/lab_ipa.png", 864, 768, 121861, 541691}, Case{"stage/autolab.png", 809, 689, 533216, 24185},
        Case{"stage/cave.png", 500, 500, 244730, 5270}, Case{"stage/simple_rooms.png", 400, 300, 83184, 36816}}) {
    const fs::path file = data(std::string("maps/") + c.name);
    NEEDS(file);
    const FloorPlan plan = load_plan(file, {.resolution_m = 0.05});
    EXPECT_EQ(plan.width, c.width) << c.name;
    EXPECT_EQ(plan.height, c.height) << c.name;
    EXPECT_EQ(counts(plan)[0], c.free) << c.name;
    EXPECT_EQ(counts(plan)[1], c.occupied) << c.name;
  }
}

TEST(PlanData, EveryImageIsReadAndTraced) {
  NEEDS(data("maps"));
  int images = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data("maps"))) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".png" && extension != ".pgm" && extension != ".bmp" && extension != ".yaml") continue;
    ImageScale scale;
    if (extension != ".yaml") scale.resolution_m = 0.05;
    const FloorPlan plan = load_plan(entry.path(), scale);
    const auto exact = trace(plan, {.simplify_px = 0}), simple = trace(plan);
    EXPECT_FALSE(exact.empty()) << entry.path();
    EXPECT_EQ(exact.size(), simple.size());
    ++images;
  }
  EXPECT_GE(images, 26);
}

TEST(PlanData, StageCentresItsBitmap) {
  const fs::path file = data("maps/stage/cave.png");
  NEEDS(file);
  const FloorPlan plan = load_plan(file, {.size_m = raycast::Point{16, 16}});  // simple.world
  EXPECT_NEAR(plan.resolution_m, 0.032, 1e-15);
  // The robots of simple.world stand where it is free.
  for (const auto& [x, y] : {std::pair{-6.946, -6.947}, {-3.946, -6.947}})
    EXPECT_EQ(plan.at(static_cast<std::int64_t>(std::floor((x - plan.origin.x_m) / plan.resolution_m)),
                      static_cast<std::int64_t>(std::floor((y - plan.origin.y_m) / plan.resolution_y_m))),
              PlanCell::free);
}

TEST(PlanData, MovingAiMapsAndTheirScenarios) {
  NEEDS(data("movingai"));
  int maps = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data("movingai"))) {
    if (entry.path().extension() != ".map") continue;
    ++maps;
    const FloorPlan plan = load_plan(entry.path());
    const std::string text = slurp(entry.path());
    const std::string cells = text.substr(text.find("map\n") + 4);
    const auto count = [&](char c) { return std::count(cells.begin(), cells.end(), c); };
    EXPECT_EQ(counts(plan)[0], count('.') + count('G') + count('S')) << entry.path();
    EXPECT_EQ(counts(plan)[1], count('@') + count('O') + count('T') + count('W')) << entry.path();
    EXPECT_FALSE(trace(plan).empty());
    // Starts and goals of the scenarios (x from the left, y from the top) can be entered.
    std::ifstream scenario(entry.path().string() + ".scen");
    std::string line;
    std::getline(scenario, line);
    std::size_t ends = 0;
    while (std::getline(scenario, line)) {
      std::istringstream fields(line);
      std::string bucket, name;
      std::int64_t width = 0, height = 0, x0 = 0, y0 = 0, x1 = 0, y1 = 0;
      if (!(fields >> bucket >> name >> width >> height >> x0 >> y0 >> x1 >> y1)) continue;
      ASSERT_EQ(width, plan.width);
      ASSERT_EQ(height, plan.height);
      ASSERT_EQ(plan.at(x0, plan.height - 1 - y0), PlanCell::free) << line;
      ASSERT_EQ(plan.at(x1, plan.height - 1 - y1), PlanCell::free) << line;
      ++ends;
    }
    EXPECT_GT(ends, 100u) << entry.path();
  }
  EXPECT_GE(maps, 7);
}

TEST(PlanData, SimplifiedPlansOfBuildings) {
  const fs::path file = data("maps/ipa-rooms/lab_ipa.png");
  NEEDS(file);
  const FloorPlan plan = load_plan(file, {.resolution_m = 0.05});
  raycast::World exact_world, simple_world;
  exact_world.polygons = trace(plan, {.simplify_px = 0});
  simple_world.polygons = trace(plan);
  const raycast::Scene exact(exact_world), simple(simple_world);
  EXPECT_LT(simple.surface_count(), exact.surface_count());
  std::vector<double> errors;
  std::size_t far = 0;
  for (std::int64_t y = 5; y < plan.height - 5; y += 17)
    for (std::int64_t x = 5; x < plan.width - 5; x += 17) {
      bool clear = true;
      for (std::int64_t v = -2; v <= 2; ++v)
        for (std::int64_t u = -2; u <= 2; ++u) clear &= plan.at(x + u, y + v) == PlanCell::free;
      if (!clear) continue;
      for (int i = 0; i < 360; ++i) {
        const double angle = (i + 0.5) * 3.14159265358979323846 / 180;
        const double px = (static_cast<double>(x) + 0.5) * 0.05, py = (static_cast<double>(y) + 0.5) * 0.05;
        const double a = exact.ray_range(px, py, angle, 100), b = simple.ray_range(px, py, angle, 100);
        ASSERT_LT(b, 100) << px << ' ' << py << ' ' << angle;
        errors.push_back(std::abs(a - b));
        far += errors.back() > 2 * 0.75 * 0.05;
      }
    }
  std::sort(errors.begin(), errors.end());
  const auto quantile = [&](double q) {
    return errors[static_cast<std::size_t>(q * static_cast<double>(errors.size()))];
  };
  std::cout << "[          ] " << exact.surface_count() << " segments exact, " << simple.surface_count()
            << " simplified; " << errors.size() << " rays: range error median " << quantile(0.5) << ", 95 % "
            << quantile(0.95) << ", 99 % " << quantile(0.99) << " m; beyond 7.5 cm: " << far << '\n';
  EXPECT_LT(quantile(0.5), 0.75 * 0.05);
}

}  // namespace
}  // namespace evigrid::scenes
