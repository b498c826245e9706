// SPDX-License-Identifier: Apache-2.0
// map_server yaml, MovingAI maps and the scale of bare images: every field, and every complaint with its place.
#include <gtest/gtest.h>

#include <cmath>

#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

using std::string;

const string kYaml = R"(image: "images/plan one.pgm"
resolution: 0.05
origin: [-3.5, +2., 0.25]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
)";

string with(const string& old, const string& fresh, string text = kYaml) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, string::npos) << old;
  return text.replace(at, old.size(), fresh);
}

class PlanYaml : public testing::Test {
 protected:
  PlanYaml() { folder_.write("images/plan one.pgm", "P2 3 2 255 0 255 128 0 0 0"); }
  FloorPlan load(const string& yaml, const ImageScale& scale = {}) {
    return load_plan(folder_.write("map.yaml", yaml), scale);
  }
  /// Without the folder's name.
  string complaint(const string& yaml, const ImageScale& scale = {}) {
    const string message = refusal(yaml, folder_.at("map.yaml"), scale), folder = folder_.at("");
    return message.rfind(folder, 0) == 0 ? message.substr(folder.size()) : message;
  }
  PlanFolder folder_;
};

TEST_F(PlanYaml, AllFields) {
  const FloorPlan plan = load(kYaml);
  EXPECT_EQ(rows_of(plan), "#.?\n###\n");
  EXPECT_EQ(plan.resolution_m, 0.05);
  EXPECT_EQ(plan.resolution_y_m, 0.05);
  EXPECT_EQ(plan.origin.x_m, -3.5);
  EXPECT_EQ(plan.origin.y_m, 2);
  EXPECT_EQ(plan.origin.yaw_rad, 0.25);
  EXPECT_EQ(rows_of(load(with("negate: 0", "negate: 1"))), ".#?\n...\n");
  EXPECT_EQ(rows_of(load(with("negate: 0", "negate: true"))), ".#?\n...\n");
  EXPECT_EQ(rows_of(load(with("0.196", "0.6"))), "#..\n###\n");  // the grey's p is 0.498
  EXPECT_EQ(rows_of(load(with("0.65", "0.4"))), "#.#\n###\n");
  EXPECT_EQ(rows_of(load("fresh_key: {a: [1, 2]}\n" + kYaml)), "#.?\n###\n");
  EXPECT_EQ(
      rows_of(load("{image: images/plan one.pgm, resolution: 1e-1, origin: [0, 0, 0], negate: 0, occupied_thresh: "
                   "0.65, free_thresh: 0.196, mode: scale}")),
      "#.?\n###\n");
}

TEST_F(PlanYaml, ModeRawIsPerCent) {
  folder_.write("images/plan one.pgm", "P2 6 1 255 0 19 20 66 100 101");
  EXPECT_EQ(rows_of(load(kYaml + "mode: raw\n")), "..?##?\n");
  EXPECT_EQ(rows_of(load(with("negate: 0", "negate: 1") + "mode: raw\n")), "??????\n");  // 255 − v exceeds 100
}

TEST_F(PlanYaml, AlphaByMode) {
  folder_.write("images/a.png", Png{2, 1, 8, 4, 0, string("\0\0\xff\0\0", 5)}.file());
  const string yaml = with("plan one.pgm", "a.png");
  EXPECT_EQ(rows_of(load(yaml)), "#?\n");
  EXPECT_EQ(rows_of(load(yaml + "mode: scale")), "#?\n");
  EXPECT_EQ(rows_of(load(yaml + "mode: raw")), "..\n");
}

TEST_F(PlanYaml, OriginMayBeGivenAndTheRestMayNot) {
  EXPECT_EQ(load(kYaml, {.origin = Pose{1, 2, 3}}).origin.x_m, 1);
  EXPECT_EQ(complaint(kYaml, {.resolution_m = 1}),
            "map.yaml: resolution_m, size_m: are said by the yaml itself and must not be given beside it");
}

TEST_F(PlanYaml, Complaints) {
  EXPECT_EQ(complaint(kYaml), "loaded");
  for (const string key : {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"})
    EXPECT_EQ(complaint(with(key + ":", "x" + key + ":")), "map.yaml:1: " + key + ": is missing");
  EXPECT_EQ(complaint(with("0.05", "five")), "map.yaml:2: resolution: must be a number");
  EXPECT_EQ(complaint(with("0.05", "0.05m")), "map.yaml:2: resolution: must be a number");
  EXPECT_EQ(complaint(with("0.05", "")), "map.yaml:2: resolution: must be a number");
  EXPECT_EQ(complaint(with("0.05", "[0.05]")), "map.yaml:2: resolution: must be a number");
  EXPECT_EQ(complaint(with("0.05", ".nan")), "map.yaml:2: resolution: must be a number");
  EXPECT_EQ(complaint(with("0.05", "nan")), "map.yaml:2: resolution: must be finite");
  EXPECT_EQ(complaint(with("0.05", "0")), "map.yaml:2: resolution: must be greater than 0 (1e-06 or more)");
  EXPECT_EQ(complaint(with("0.05", "-0.05")), "map.yaml:2: resolution: is -0.05, must be within [0, 1000]");
  EXPECT_EQ(complaint(with("[-3.5, +2., 0.25]", "[-3.5, 2]")), "map.yaml:3: origin: must be [x, y, yaw]");
  EXPECT_EQ(complaint(with("[-3.5, +2., 0.25]", "0")), "map.yaml:3: origin: must be [x, y, yaw]");
  EXPECT_EQ(complaint(with("+2.", "inf")), "map.yaml:3: origin[1]: must be finite");
  EXPECT_EQ(complaint(with("+2.", "1e8")), "map.yaml:3: origin[1]: is 1e8, must be within [-1e+07, 1e+07]");
  EXPECT_EQ(complaint(with("negate: 0", "negate: 2")), "map.yaml:4: negate: must be 0 or 1");
  EXPECT_EQ(complaint(with("0.65", "65")), "map.yaml:5: occupied_thresh: is 65, must be within [0, 1]");
  EXPECT_EQ(complaint(with("0.196", "0.7")), "map.yaml:6: free_thresh: is greater than occupied_thresh");
  EXPECT_EQ(complaint(kYaml + "mode: trinaryy"), "map.yaml:7: mode: is trinaryy, must be trinary, scale or raw");
  EXPECT_EQ(complaint(kYaml + "negate: 1"), "map.yaml:7: negate: is given twice");
  EXPECT_EQ(complaint("- a\n- b"), "map.yaml:1: yaml: is not a table of keys and values");
  EXPECT_EQ(complaint("just text"), "map.yaml:1: yaml: is not a table of keys and values");
  EXPECT_EQ(complaint("\n\nimage: [a\n").substr(0, 15), "map.yaml:4: yam");
  EXPECT_EQ(complaint(with("plan one", "none")), "images/none.pgm: there is no such file");
  EXPECT_EQ(complaint(with("\"images/plan one.pgm\"", "map.yaml")).substr(0, 10), "map.yaml: ");
  EXPECT_EQ(complaint(with("images/plan one.pgm", "/dev/zero")), "/dev/zero: is not a regular file");
  EXPECT_EQ(complaint(with("images/plan one.pgm", "images")), "images: is not a regular file");
  folder_.write("images/plan one.pgm", "P2 3 2 255 0 255 128 0 0");
  EXPECT_EQ(complaint(kYaml), "images/plan one.pgm:1: pixel 5: is missing: the file ends here");
  folder_.write("again.yaml", kYaml);  // a yaml is no image: no endless loop
  EXPECT_EQ(complaint(with("images/plan one.pgm", "again.yaml")),
            "again.yaml: format: is not known by its extension; images are .pgm, .png or .bmp");
}

TEST(PlanScale, BareImages) {
  const string image = "P2 4 2 1 0 1 1 1 1 1 1 1";
  FloorPlan plan = load_text(image, "a.pgm", {.resolution_m = 0.1});
  EXPECT_EQ(plan.resolution_m, 0.1);
  EXPECT_EQ(plan.resolution_y_m, 0.1);
  EXPECT_EQ(plan.origin.x_m, 0);
  // Stage: the whole image is 16 × 4 m around the model's origin; pixels need not be square.
  plan = load_text(image, "a.pgm", {.size_m = raycast::Point{16, 4}});
  EXPECT_EQ(plan.resolution_m, 4);
  EXPECT_EQ(plan.resolution_y_m, 2);
  EXPECT_EQ(plan.origin.x_m, -8);
  EXPECT_EQ(plan.origin.y_m, -2);
  plan = load_text(image, "a.pgm", {.size_m = raycast::Point{16, 4}, .origin = Pose{1, 2, 0.5}});
  EXPECT_EQ(plan.origin.x_m, 1);
  EXPECT_EQ(plan.origin.yaw_rad, 0.5);

  EXPECT_EQ(refusal(image, "a.pgm"), "a.pgm: resolution_m: is missing: an image alone does not say its scale");
  EXPECT_EQ(refusal(image, "a.pgm", {.resolution_m = 1, .size_m = raycast::Point{1, 1}}),
            "a.pgm: size_m: is given together with resolution_m: one of them is enough");
  EXPECT_EQ(refusal(image, "a.pgm", {.resolution_m = 0}), "a.pgm: resolution_m: must be within [1e-06, 1000]");
  EXPECT_EQ(refusal(image, "a.pgm", {.resolution_m = NAN}), "a.pgm: resolution_m: must be within [1e-06, 1000]");
  EXPECT_EQ(refusal(image, "a.pgm", {.size_m = raycast::Point{1, -1}}), "a.pgm: size_m: must be within [1e-06, 1e+07]");
  EXPECT_EQ(refusal(image, "a.pgm", {.resolution_m = 1, .origin = Pose{INFINITY, 0, 0}}),
            "a.pgm: origin: must be finite, at most 1e+07 m away");
  EXPECT_EQ(refusal(image, "a.pgm", {.resolution_m = 1, .occupied_threshold = 1.5}),
            "a.pgm: occupied_threshold: must be within [0, 1]");
  EXPECT_EQ(refusal(image, "a.pgm", {.resolution_m = 1, .free_threshold = 0.8}),
            "a.pgm: free_threshold: must be within [0, occupied_threshold]");
  EXPECT_EQ(refusal(image, "a.jpg", {.resolution_m = 1}),
            "a.jpg: format: is not known by its extension; plans are .yaml, .yml, .map, .pgm, .png or .bmp");
  EXPECT_EQ(refusal(image, "a.png", {.resolution_m = 1}), "a.png: format: is not PNG: the signature is missing");
  EXPECT_EQ(refusal(image, "a.bmp", {.resolution_m = 1}), "a.bmp: format: is not BMP: the file does not start with BM");
  EXPECT_EQ(refusal("P6 1 1 255 abc", "a.pgm", {.resolution_m = 1}),
            "a.pgm:1: format: is not PGM: the file starts with neither P2 nor P5");
  EXPECT_EQ(refusal("", "a.pgm", {.resolution_m = 1}), "a.pgm: is empty");
}

TEST(PlanMovingAi, FirstRowIsOnTop) {
  const FloorPlan plan = load_text("type octile\nheight 3\nwidth 4\nmap\n@@@@\n.GSO\nTW..\n", "a.map");
  EXPECT_EQ(rows_of(plan), "####\n...#\n##..\n");
  EXPECT_EQ(plan.at(0, 2), PlanCell::occupied);
  EXPECT_EQ(plan.at(0, 1), PlanCell::free);
  EXPECT_EQ(plan.resolution_m, 1);
  EXPECT_EQ(plan.origin.x_m, 0);
  EXPECT_EQ(load_text("type octile\nheight 1\nwidth 1\nmap\n.", "a.map", {.resolution_m = 0.5}).resolution_y_m, 0.5);
  EXPECT_EQ(rows_of(load_text("type octile\r\nheight 1\r\nwidth 2\r\nmap\r\n.@\r\n\r\n", "a.map")), ".#\n");
}

TEST(PlanMovingAi, Complaints) {
  const string good = "type octile\nheight 2\nwidth 3\nmap\n@.@\n...\n";
  EXPECT_EQ(refusal(good, "a.map"), "loaded");
  EXPECT_EQ(refusal(with("octile", "tile", good), "a.map"), "a.map:1: type: must be 'type octile'");
  EXPECT_EQ(refusal(with("height 2", "height", good), "a.map"), "a.map:2: height: expected 'height N'");
  EXPECT_EQ(refusal(with("height 2", "height 2x", good), "a.map"), "a.map:2: height: must be a whole number");
  EXPECT_EQ(refusal(with("width 3", "width 0", good), "a.map"), "a.map: size: is 0 x 2, both must be positive");
  EXPECT_EQ(refusal(with("width 3", "width -3", good), "a.map"), "a.map: size: is -3 x 2, both must be positive");
  EXPECT_EQ(refusal(with("height 2", "height 9999999999999", good), "a.map"),
            "a.map: size: is 3 x 9999999999999, a plan has at most 268435456 pixels");
  EXPECT_EQ(refusal(with("height 2", "height 9", good), "a.map"),
            "a.map:4: map: the file ends early: 8 bytes of cells, at least 35 needed");
  EXPECT_EQ(refusal(with("map\n", "mop\n", good), "a.map"), "a.map:4: map: must be the word 'map'");
  EXPECT_EQ(refusal(with("@.@", "@.@.", good), "a.map"), "a.map:5: row 0: has 4 cells, width is 3");
  EXPECT_EQ(refusal(with("...", "..", good + "\n\n"), "a.map"), "a.map:6: row 1: has 2 cells, width is 3");
  EXPECT_EQ(refusal(with("...", ".x.", good), "a.map"), "a.map:6: row 1: cell 1 is none of . G S @ O T W");
  EXPECT_EQ(refusal(good + "...\n", "a.map"), "a.map:7: map: has more rows than height 2");
}

}  // namespace
}  // namespace evigrid::scenes
