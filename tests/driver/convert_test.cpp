// SPDX-License-Identifier: Apache-2.0
// evigrid convert: plans to maps and back, parts of maps.
#include <gtest/gtest.h>

#include <cmath>

#include "evigrid/evigrid.hpp"
#include "evigrid/scenes/plan.hpp"
#include "mapped_drive.hpp"

namespace evigrid::driver {
namespace {

TEST(Convert, AMapServerMapBecomesAMapAndComesBack) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  for (const std::string mode : {"trinary", "raw"}) {
    const std::string yaml = dir.at("a.yaml"), back = dir.at("b.yaml"), ours = dir.at("m.evigrid");
    ASSERT_EQ(evigrid({"export", out, "-o", yaml, "--mode", mode}).code, 0);
    const Ran ran = evigrid({"convert", yaml, "-o", ours, "--certainty", "1", "--rule", "dempster"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");  // whole cells: no pixel was moved
    ASSERT_EQ(evigrid({"convert", ours, "-o", back, "--mode", mode}).code, 0);
    const scenes::FloorPlan a = scenes::load_plan(yaml), b = scenes::load_plan(back);
    const auto at = [](const scenes::FloorPlan& plan, std::int64_t ix, std::int64_t iy) {
      const std::int64_t x = ix - std::llround(plan.origin.x_m / 0.1), y = iy - std::llround(plan.origin.y_m / 0.1);
      if (x < 0 || y < 0 || x >= plan.width || y >= plan.height) return -1;
      return static_cast<int>(plan.occupancy[static_cast<std::size_t>(y * plan.width + x)]);
    };
    for (std::int64_t y = -100; y < 100; ++y) {
      for (std::int64_t x = -100; x < 100; ++x) ASSERT_EQ(at(a, x, y), at(b, x, y)) << x << ' ' << y << ' ' << mode;
    }
  }
  const Map map = load(dir.at("m.evigrid"));
  EXPECT_EQ(map.params().rule, Rule::dempster);
  EXPECT_EQ(map.params().cell_m, 0.1);
}

TEST(Convert, CertaintyIsWhatIsKnown) {
  const TempDir dir;
  dir.write("a.pgm", "P2 3 2 255\n0 254 205\n254 0 0\n");
  const std::string yaml = dir.write("a.yaml",
                                     "image: a.pgm\nresolution: 0.5\norigin: [-1.0, 2.5, 0]\nnegate: 0\n"
                                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  ASSERT_EQ(evigrid({"convert", yaml, "-o", dir.at("m.evigrid"), "--certainty", "0.75"}).code, 0);
  const Map map = load(dir.at("m.evigrid"));
  EXPECT_EQ(map.bounds(), (CellRect{-2, 5, 3, 2}));
  EXPECT_EQ(map.mass({-2, 5}), (Mass{0.75F, 0, 0.25F}));  // the lower row is the image's last
  EXPECT_EQ(map.mass({-1, 5}), (Mass{0, 0.75F, 0.25F}));
  EXPECT_EQ(map.mass({-2, 6}), (Mass{0, 0.75F, 0.25F}));
  EXPECT_EQ(map.mass({0, 6}), Mass{});
  // A part of a saved map as a saved map.
  ASSERT_EQ(evigrid({"convert", dir.at("m.evigrid"), "-o", dir.at("p.evigrid"), "--region", "-1,2.5,-0.5,3"}).code, 0);
  EXPECT_EQ(load(dir.at("p.evigrid")).bounds(), (CellRect{-2, 5, 1, 1}));
}

TEST(Convert, ATurnedPlanIsTakenUnderTheCentresOfCells) {
  const TempDir dir;
  dir.write(
      "a.pgm", "P2 40 20 255\n" + [] {
        std::string all;
        for (int i = 0; i < 800; ++i) all += i % 40 < 20 ? "0 " : "254 ";
        return all;
      }());
  const std::string yaml = dir.write("a.yaml",
                                     "image: a.pgm\nresolution: 0.1\norigin: [1.03, 2.0, 0.5235987755982988]\n"
                                     "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const Ran ran = evigrid({"convert", yaml, "-o", dir.at("m.evigrid"), "--certainty", "1"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(contains(ran.err, "under its centre")) << ran.err;
  const Map map = load(dir.at("m.evigrid"));
  const auto at = [&](double along, double across) {  // in the plan, m
    const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
    return map.mass(map.cell_at(1.03 + along * c - across * s, 2 + along * s + across * c));
  };
  EXPECT_EQ(at(0.5, 1).o, 1);
  EXPECT_EQ(at(1.8, 1.8).o, 1);
  EXPECT_EQ(at(2.2, 0.2).e, 1);
  EXPECT_EQ(at(3.8, 1).e, 1);
  EXPECT_EQ(at(-0.2, 1), Mass{});
  EXPECT_EQ(at(2, 2.2), Mass{});
  std::int64_t known = 0;
  const CellRect b = map.bounds();
  for (std::int64_t y = b.y; y < b.y + b.height; ++y)
    for (std::int64_t x = b.x; x < b.x + b.width; ++x) known += map.mass({x, y}) != Mass{};
  EXPECT_NEAR(static_cast<double>(known), 800, 20);
}

TEST(Convert, BadInputIsNamedAndLeavesNothing) {
  const TempDir dir;
  const auto refused = [&](std::vector<std::string> args, const std::string& why) {
    const auto before = dir.names();
    const Ran ran = evigrid(args);
    EXPECT_EQ(ran.code, 2) << why;
    EXPECT_TRUE(contains(ran.err, why)) << ran.err;
    EXPECT_EQ(dir.names(), before);
  };
  refused({"convert", dir.at("none.yaml"), "-o", dir.at("x.evigrid")}, "none.yaml");
  refused({"convert", dir.write("a.pgm", "P2 1 1 255 0\n"), "-o", dir.at("x.evigrid")}, "resolution_m: is missing");
  refused({"convert", dir.at("a.pgm"), "--resolution", "1", "-o", dir.at("x.evigrid"), "--certainty", "1.5"},
          "--certainty");
  refused({"convert", dir.at("a.pgm"), "--resolution", "1", "-o", dir.at("x.evigrid"), "--region", "0,0,1,1"},
          "--region: is for saved maps");
}

TEST(Convert, WhatWouldBeIgnoredIsRefused) {
  const TempDir dir;
  const std::string out = mapped_drive(dir), ours = dir.at("x.evigrid");
  const std::string plan = dir.write("a.pgm", "P2 1 1 255 0\n");
  const auto refused = [&](std::vector<std::string> args, const std::string& why) {
    args.insert(args.begin(), "convert");
    const auto before = dir.names();
    const Ran ran = evigrid(args);
    EXPECT_EQ(ran.code, 2) << why;
    EXPECT_TRUE(contains(ran.err, why)) << ran.err;
    EXPECT_EQ(dir.names(), before);
  };
  for (const std::vector<std::string>& one :
       {std::vector<std::string>{"--rule", "dempster"}, {"--certainty", "7"}, {"--resolution=-3"}}) {
    std::vector<std::string> args{out, "-o", dir.at("x.yaml")};
    args.insert(args.end(), one.begin(), one.end());
    refused(args, one[0].substr(0, one[0].find('=')) + ": is for plans");
  }
  for (const std::vector<std::string>& one : {std::vector<std::string>{"--mode", "foo"},
                                              {"--occupied", "2"},
                                              {"--free", "9"},
                                              {"--max-unknown", "2"},
                                              {"--slab", "2,1"},
                                              {"--planes", "foo"},
                                              {"--frame", "f"},
                                              {"--topic", "t"},
                                              {"--max-image-mb=-1"},
                                              {"--metres"}}) {
    for (std::vector<std::string> args :
         {std::vector<std::string>{out, "-o", ours}, {plan, "--resolution", "1", "-o", ours}}) {
      args.insert(args.end(), one.begin(), one.end());
      refused(args, one[0].substr(0, one[0].find('=')) + ": says nothing of a saved map");
    }
  }
}

TEST(Convert, ALinkIsFollowedAndStays) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  dir.write("real.evigrid", "old");
  std::filesystem::create_symlink(dir.at("real.evigrid"), dir.at("link.evigrid"));
  ASSERT_EQ(evigrid({"convert", out, "-o", dir.at("link.evigrid")}).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(dir.at("link.evigrid")));
  EXPECT_EQ(load(dir.at("real.evigrid")).hash(), load(out + "/map.evigrid").hash());
  ASSERT_EQ(evigrid({"convert", out, "-o", dir.at("plan.yml")}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(dir.at("plan.yml")));
}

}  // namespace
}  // namespace evigrid::driver
