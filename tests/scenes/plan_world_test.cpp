// SPDX-License-Identifier: Apache-2.0
// Plans in a scene file: every field, files found from the scene's folder on, and every complaint with its place.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "evigrid/scenes/scene.hpp"
#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

using std::string;

class PlanWorld : public testing::Test {
 protected:
  PlanWorld() {
    folder_.write("plans/a.pgm", "P2 3 2 255 0 255 128 255 255 255");  // wall at the upper left, unknown at the right
    folder_.write(
        "plans/a.yaml",
        "image: a.pgm\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.1\n");
    folder_.write("plans/m.map", "type octile\nheight 1\nwidth 2\nmap\n.@\n");
  }
  static string scene(const string& world) {
    return "[map]\ncell_m = 0.1\nrule = \"pcr5\"\n[world]\n" + world +
           "\n[robot.sensor]\nmodel = \"li2014\"\naperture_deg = 15\nmin_range_m = 0.1\nmax_range_m = 5\n"
           "[robot.ring]\ncount = 4\nradius_m = 0.2\n[trajectory]\nwaypoints = [[1, 1], [2, 1]]\nseed = 7\n"
           "[material.glass]\ncritical_incidence_deg = 20\nabsorption = 0.25\n[material.felt]\nabsorption = 0.9\n";
  }
  raycast::World world(const string& text) { return load_scene(folder_.write("s.toml", scene(text))).world; }
  /// Without the folder's name and the scene's.
  string complaint(const string& text) {
    try {
      (void)world(text);
    } catch (const SceneError& e) {
      string message = e.what();
      for (std::size_t at; (at = message.find(folder_.at(""))) != string::npos;)
        message.erase(at, folder_.at("").size());
      return message;
    }
    return "loaded";
  }
  PlanFolder folder_;
};

string vertices(const raycast::Polygon& polygon) {
  std::ostringstream out;
  for (const raycast::Point& p : polygon.vertices) out << p.x_m << ',' << p.y_m << ' ';
  return out.str();
}

TEST_F(PlanWorld, Yaml) {
  const raycast::World w = world("[[world.plans]]\nfile = \"plans/a.yaml\"\nmaterial = \"glass\"");
  ASSERT_EQ(w.polygons.size(), 1u);
  EXPECT_EQ(vertices(w.polygons[0]), "1.5,2.5 1.5,3 1,3 1,2.5 ");
  EXPECT_NEAR(w.polygons[0].material.critical_incidence_rad, 20 * std::numbers::pi / 180, 1e-15);
  EXPECT_EQ(w.polygons[0].material.absorption, 0.25);
  EXPECT_EQ(vertices(world("[[world.plans]]\nfile = \"plans/a.yaml\"\norigin = [0, 0]").polygons[0]),
            "0.5,0.5 0.5,1 0,1 0,0.5 ");
  EXPECT_EQ(vertices(world("[[world.plans]]\nfile = \"" + folder_.at("plans/a.yaml") + "\"").polygons[0]),
            "1.5,2.5 1.5,3 1,3 1,2.5 ");
}

TEST_F(PlanWorld, Image) {
  const raycast::World w = world(
      "[[world.plans]]\nfile = \"plans/a.pgm\"\nresolution_m = 1\nnegate = true\noccupied_threshold = 0.4\n"
      "free_threshold = 0.3\nsimplify_px = 0\nborder = true\n[[world.walls]]\nfrom = [0, 0]\nto = [1, 1]\n"
      "[[world.plans]]\nfile = \"plans/a.pgm\"\nsize_m = [6, 8]\nunknown = \"wall\"\nmaterial = \"felt\"");
  EXPECT_EQ(w.walls.size(), 1u);
  ASSERT_EQ(w.polygons.size(), 4u);
  EXPECT_EQ(vertices(w.polygons[0]), "3,0 3,2 1,2 1,1 0,1 0,0 ");  // all but the black pixel
  EXPECT_EQ(vertices(w.polygons[1]), "0,0 3,0 3,2 0,2 ");
  EXPECT_EQ(vertices(w.polygons[2]), "-1,0 -1,4 -3,4 -3,0 ");  // centred, pixels of 2 × 4 m
  EXPECT_EQ(vertices(w.polygons[3]), "3,0 3,4 1,4 1,0 ");
  EXPECT_EQ(w.polygons[3].material.absorption, 0.9);
  EXPECT_EQ(w.polygons[3].material.critical_incidence_rad, std::numbers::pi / 2);
  const raycast::World turned = world("[[world.plans]]\nfile = \"plans/m.map\"\norigin = [0, 5, 90]");
  EXPECT_NEAR(turned.polygons[0].vertices[0].y_m, 7, 1e-12);
  EXPECT_NEAR(turned.polygons[0].vertices[0].x_m, 0, 1e-12);
}

TEST_F(PlanWorld, Complaints) {
  const auto plan = [](const string& fields) { return "[[world.plans]]\n" + fields; };
  EXPECT_EQ(complaint(plan("resolution_m = 1")), "s.toml:5: world.plans[0].file: is missing");
  EXPECT_EQ(complaint(plan("file = \"plans/none.yaml\"")),
            "s.toml:6: world.plans[0].file: plans/none.yaml: there is no such file");
  EXPECT_EQ(complaint(plan("file = \"plans\"")), "s.toml:6: world.plans[0].file: plans: is not a regular file");
  EXPECT_EQ(complaint(plan("file = \"/dev/zero\"")), "s.toml:6: world.plans[0].file: /dev/zero: is not a regular file");
  EXPECT_EQ(
      complaint(plan("file = \"plans/a.pgm\"")),
      "s.toml:6: world.plans[0].file: plans/a.pgm: resolution_m: is missing: an image alone does not say its scale");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"\nresolution_m = 1")),
            "s.toml:7: world.plans[0].resolution_m: is said by the yaml itself");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"\nnegate = false")),
            "s.toml:7: world.plans[0].negate: is said by the yaml itself");
  EXPECT_EQ(complaint(plan("file = \"plans/m.map\"\nnegate = true")),
            "s.toml:7: world.plans[0].negate: has no meaning for a MovingAI map");
  EXPECT_EQ(complaint(plan("file = \"plans/a.pgm\"\nresolution_m = 0")),
            "s.toml:7: world.plans[0].resolution_m: is 0, must be within [1e-06, 1000]");
  EXPECT_EQ(complaint(plan("file = \"plans/a.pgm\"\nresolution_m = 1\nsize_m = [1, 1]")),
            "s.toml:8: world.plans[0].size_m: is given together with resolution_m: one of them is enough");
  EXPECT_EQ(complaint(plan("file = \"plans/a.pgm\"\nsize_m = [1, 0]")),
            "s.toml:7: world.plans[0].size_m: both sides must be positive");
  EXPECT_EQ(complaint(plan("file = \"plans/a.pgm\"\nresolution_m = 1\nfree_threshold = 0.7")),
            "s.toml:8: world.plans[0].free_threshold: is greater than occupied_threshold");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"\nunknown = \"grey\"")),
            "s.toml:7: world.plans[0].unknown: is grey, must be free or wall");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"\nsimplify_px = -1")),
            "s.toml:7: world.plans[0].simplify_px: is -1, must be within [0, 100]");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"\nmaterial = \"wood\"")),
            "s.toml:7: world.plans[0].material: there is no [material.wood]");
  EXPECT_EQ(complaint(plan("file = \"plans/a.pgm\"\nresolution = 1")),
            "s.toml:7: world.plans[0].resolution: is unknown; did you mean resolution_m?");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"\nborders = true")),
            "s.toml:7: world.plans[0].borders: is unknown; did you mean border?");
  folder_.write("plans/a.pgm", "P2\n3 2 255\n10 20 30 40 50");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"")),
            "s.toml:6: world.plans[0].file: plans/a.pgm:3: pixel 5: is missing: the file ends here");
  folder_.write("plans/a.yaml", "image: a.pgm\nresolution: x\n");
  EXPECT_EQ(complaint(plan("file = \"plans/a.yaml\"")),
            "s.toml:6: world.plans[0].file: plans/a.yaml:2: resolution: must be a number");
}

TEST_F(PlanWorld, MeshesAndBuildings) {
  EXPECT_EQ(complaint("[[world.meshes]]\nfile = \"m.ply\"\nup = \"x\""),
            "s.toml:7: world.meshes[0].up: is x, must be z or y");
  EXPECT_EQ(complaint("[[world.meshes]]\nfile = \"m.ply\"\nscale = 0"),
            "s.toml:7: world.meshes[0].scale: is 0, must be within (0, 1e+06]");
  EXPECT_EQ(complaint("[[world.meshes]]\nfile = \"m.ply\"\nheight = 1"),
            "s.toml:7: world.meshes[0].height: is unknown; did you mean height_m?");
  EXPECT_EQ(complaint("[world.building]\nwidth_m = 10000\ndepth_m = 10000"),
            "s.toml:5: world.building.room_m: the building would have more than 100000 rooms");
  EXPECT_EQ(complaint("[world.building]\nwidth = 10"),
            "s.toml:6: world.building.width: is unknown; did you mean width_m?");
}

}  // namespace
}  // namespace evigrid::scenes
