// SPDX-License-Identifier: Apache-2.0
// Saved maps from the command line: written by `map`, told by `info`, drawn by `show`, and refused when damaged.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "driver/decoded_png.hpp"
#include "picture/map_picture.hpp"
#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

/// A folder with the map of one scan.
std::string mapped(const TempDir& dir, std::vector<std::string> more = {}) {
  std::vector<std::string> all{"map", dir.write("a.log", flaser(180, "3.5", 1)), "-o", dir.at("out")};
  all.insert(all.end(), more.begin(), more.end());
  const Ran ran = evigrid(all);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return dir.at("out");
}

TEST(Info, TellsWhatASavedMapHolds) {
  const TempDir dir;
  const std::string out = mapped(dir, {"--cell", "0.1", "--rule", "pcr2"});
  const Json report = Json::parse(slurp(out + "/report.json"));
  for (const std::string& map : {out, out + "/map.evigrid"}) {
    const Json info = Json::parse(evigrid({"info", map, "--json", "-"}).out);
    for (const char* key :
         {"map_hash", "rule", "cell_m", "size_cells", "origin_cells", "tiles", "memory_bytes", "maths_version"})
      EXPECT_EQ(info[key], report[key]) << key;
    EXPECT_EQ(info["file"], out + "/map.evigrid");
    EXPECT_EQ(info["layers"], Json({"e", "o", "u", "conflict"}));
    EXPECT_EQ(info["sensors"][0]["model"], "beam");
    EXPECT_EQ(info["sensors"][0]["beams"], 180);
  }
  const Ran text = evigrid({"info", out});
  EXPECT_TRUE(contains(text.out, report["map_hash"].get<std::string>()));
  EXPECT_TRUE(contains(text.out, "1 x model beam"));
}

TEST(Show, PicturesAndTheTerminal) {
  const TempDir dir;
  const std::string out = mapped(dir);
  const Ran text = evigrid({"show", out, "--columns", "60"});
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_TRUE(contains(text.out, "##"));
  EXPECT_EQ(text.out.find('\x1b'), std::string::npos);  // a pipe is no terminal
  for (const LookRow& row : all_looks()) {
    const std::string file = dir.at(std::string(row.name) + ".png");
    const Ran ran = evigrid({"show", out, "--layer", std::string(row.name), "-o", file});
    if (row.look == Look::con || row.look == Look::last_conflict) {  // this map keeps neither
      EXPECT_EQ(ran.code, 2);
      EXPECT_TRUE(contains(ran.err, fmt::format("keeps no {0}; map with --layers {0}", row.name))) << ran.err;
      EXPECT_FALSE(std::filesystem::exists(file));
      continue;
    }
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_GT(decode_png(slurp(file)).width, 500);
  }
  ASSERT_EQ(evigrid({"show", out, "--surface", "-o", dir.at("s.png")}).code, 0);
  EXPECT_EQ(slurp(dir.at("s.png")), slurp(dir.at("surface.png")));
  ASSERT_EQ(evigrid({"show", out, "--rect", "1,2,2,2.5", "--scale", "50", "-o", dir.at("part.png")}).code, 0);
  EXPECT_EQ(decode_png(slurp(dir.at("part.png"))).width, 20 * 50 + 32);  // 20 cells of 0.05 m
}

TEST(Show, EveryLayerOfAMapThatKeepsAll) {
  const TempDir dir;
  const std::string out = mapped(dir, {"--layers", "con,last_conflict"});
  for (const LookRow& row : all_looks()) {
    const std::string file = dir.at(std::string(row.name) + ".png");
    const Ran ran = evigrid({"show", out, "--layer", std::string(row.name), "-o", file});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_GT(decode_png(slurp(file)).width, 500);
  }
}

TEST(Map, AllLayersAreThoseOfTheMapAsItIs) {
  const TempDir dir;
  mapped(dir, {"--layers", "all"});
  const auto names = dir.names();
  for (const LookRow& row : all_looks()) {
    const bool kept = row.look != Look::con && row.look != Look::last_conflict;
    EXPECT_EQ(names.contains("out/layer_" + std::string(row.name) + ".png"), kept) << row.name;
  }
}

TEST(Show, BadRequestsAreNamed) {
  const TempDir dir;
  const std::string out = mapped(dir);
  const auto refused = [&](std::vector<std::string> more, const std::string& part) {
    std::vector<std::string> all{"show", out};
    all.insert(all.end(), more.begin(), more.end());
    const Ran ran = evigrid(all);
    EXPECT_EQ(ran.code, 2) << part;
    EXPECT_TRUE(contains(ran.err, part));
  };
  refused({"--layer", "nothing"}, "--layer: 'nothing'");
  refused({"--surface"}, "name a file with -o");
  refused({"--rect", "2,2,1,1"}, "--region");
  refused({"--rect", "0,0,nan,1"}, "--region");
  refused({"--rect", "0,0,1e300,1"}, "--region");
  refused({"--rect", "-1e6,-1e6,1e6,1e6", "-o", dir.at("x.png")}, "x.png (--region shows a part) refused");
  refused({"--scale", "20000", "-o", dir.at("x.png")}, "x.png refused");
  refused({"-o", dir.at("no/x.png")}, "no/x.png");
  EXPECT_FALSE(dir.names().contains("x.png"));
}

TEST(Map, LayersCostsAndModesAreWrittenTogether) {
  const TempDir dir;
  const std::string out = mapped(dir, {"--layers", "betp,surface", "--costmap", "--pgm-mode", "raw"});
  const auto names = dir.names();
  for (const char* file :
       {"layer_betp.png", "layer_surface.png", "costmap.npy", "costmap.pgm", "occupancy.npy", "map.evigrid"})
    EXPECT_TRUE(names.contains(std::string("out/") + file)) << file;
  EXPECT_FALSE(names.contains("out/layer_bel.png"));
  EXPECT_TRUE(contains(slurp(out + "/map.yaml"), "mode: raw"));
  const std::string log = dir.at("a.log");
  EXPECT_EQ(evigrid({"map", log, "-o", dir.at("b"), "--layers", "no"}).code, 2);
  EXPECT_EQ(evigrid({"map", log, "-o", dir.at("b"), "--pgm-mode", "no"}).code, 2);
  // The picture is what does not fit here: the planes of 140 × 140 cells do.
  const Ran big = evigrid({"map", log, "-o", dir.at("b"), "--layers", "surface", "--max-image-mb", "4"});
  EXPECT_EQ(big.code, 2);
  EXPECT_TRUE(contains(big.err, "layer_surface.png refused"));
  for (const std::string& name : dir.names()) EXPECT_FALSE(name.starts_with("b")) << name;
}

TEST(SavedMap, DamageIsNamedAndExitsWithTwo) {
  const TempDir dir;
  const std::string out = mapped(dir), whole = slurp(out + "/map.evigrid");
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 4);
  const std::vector<std::pair<std::string, std::string>> cases{{"", "is empty"},
                                                               {"hello", "is not an evigrid map"},
                                                               {whole.substr(0, whole.size() - 9), "truncated"},
                                                               {flipped, "checksum"}};
  for (const auto& [bytes, part] : cases) {
    const std::string file = dir.write("bad.evigrid", bytes);
    for (const char* command : {"info", "show"}) {
      const Ran ran = evigrid({command, file});
      EXPECT_EQ(ran.code, 2) << command;
      EXPECT_TRUE(contains(ran.err, "bad.evigrid: "));
      EXPECT_TRUE(contains(ran.err, part));
      EXPECT_EQ(ran.out, "");
    }
  }
  EXPECT_EQ(evigrid({"show", dir.at("absent")}).code, 2);
  EXPECT_EQ(evigrid({"info", dir.at("")}).code, 2);  // a folder without a map
}

}  // namespace
}  // namespace evigrid::driver
