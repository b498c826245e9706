// SPDX-License-Identifier: Apache-2.0
// `evigrid paper`: the page and its parts, the command on its shortened run, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paper/page.hpp"
#include "paper/paper.hpp"
#include "paper/plot.hpp"
#include "paper/turning_surface.hpp"
#include "program.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {
namespace {

TEST(Page, Base64OfEveryRest) {  // RFC 4648, section 10
  const auto encoded = [](std::string_view text) { return base64(std::as_bytes(std::span(text.data(), text.size()))); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Page, TextCannotBecomeMarkup) {
  Page page("a < b", "x & y");
  page.findings({{"<script>", "\"1\"", "2", Aim::target, false, "so", {}}});
  const std::string html = page.html();
  EXPECT_EQ(html.find("<script>"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(html.find("a &lt; b"), std::string::npos);
  EXPECT_NE(html.find("not met"), std::string::npos);
}

TEST(Plot, TicksAreRoundAndInside) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(-0.3, 0.3, 4).size(), 3u);
  EXPECT_NEAR(ticks(-0.3, 0.3, 4)[2], 0.2, 1e-12);
  const std::string svg = svg_plot({"t", "x", "y"}, {{"one", {{0, 1}, {1, NAN}, {2, 3}}}});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

nlohmann::json untimed(const nlohmann::json& findings) {
  nlohmann::json out = nlohmann::json::array();
  for (const auto& f : findings) {
    if (!f.contains("timed")) out.push_back(f);
  }
  return out;
}

/// The shortened run of each paper, the same code as the whole one.
class PaperRun : public testing::TestWithParam<std::string> {};
TEST_P(PaperRun, ReportsEachFigureAndItsMapsAreSound) {
  TempDir dir;
  const auto run = [&](const char* out, const char* threads) {
    const Ran ran = evigrid({"paper", GetParam().c_str(), "--quick", "-o", dir.at(out), "--threads", threads});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return nlohmann::json::parse(slurp(dir.at(std::string(out) + "/report.json")));
  };
  const auto one = run("one", "1"), two = run("two", "2");
  EXPECT_EQ(untimed(one["findings"]), untimed(two["findings"]));  // whatever the threads
  std::size_t targets = 0, floors = 0;
  for (const auto& f : one["findings"]) {
    const std::string aim = f["aim"], name = f["name"];
    EXPECT_EQ(f.contains("met"), aim == "target" || aim == "floor") << name;
    EXPECT_EQ(f["published"].get<std::string>().empty(), aim == "fact") << name;
    EXPECT_FALSE(f["ours"].get<std::string>().empty()) << name;
    EXPECT_FALSE(f["obtained"].get<std::string>().empty()) << name;
    EXPECT_TRUE(f.contains("value")) << name;
    targets += aim == "target";
    floors += aim == "floor";
    if (aim == "floor") {
      EXPECT_TRUE(f["met"].get<bool>()) << name << ": " << f["ours"];
    }
  }
  EXPECT_GE(targets, 2u);
  EXPECT_GE(floors, 3u);  // precision, recall, mistaken rate of a map at least
  const std::string html = slurp(dir.at("one/report.html"));
  EXPECT_NE(html.find("data:image/png;base64,"), std::string::npos);
  for (std::size_t at = 0; (at = html.find("http", at)) != std::string::npos; ++at)  // nothing is fetched
    EXPECT_EQ(html.compare(at, 26, "http://www.w3.org/2000/svg"), 0) << html.substr(at, 40);
}
INSTANTIATE_TEST_SUITE_P(Papers, PaperRun, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Paper& p : papers()) names.emplace_back(p.name);
                           return names;
                         }()),
                         [](const auto& one) { return one.param; });

/// ours as numbers of the finding of that name.
nlohmann::json value_of(const nlohmann::json& report, const std::string& name) {
  for (const auto& f : report["findings"]) {
    if (f["name"] == name) return f["value"];
  }
  ADD_FAILURE() << name;
  return nlohmann::json();
}

TEST(Paper, Hughes1992SettlesWithinFiveMovesAndSilenceDrawsIntoTheOpen) {
  TempDir dir;
  ASSERT_EQ(evigrid({"paper", "hughes1992", "--quick", "-o", dir.at("out")}).code, 0);
  const auto report = nlohmann::json::parse(slurp(dir.at("out/report.json")));
  EXPECT_LE(value_of(report, "most moves of a run").get<int>(), 5);
  EXPECT_GE(value_of(report, "rooms drawn at random in which all of this holds")[0].get<int>(), 2);  // of 3
  const auto drift = value_of(report, "gymnasium of 30 x 20 m: drawn from the door into the open, not to the centre");
  EXPECT_GT(drift[0].get<double>(), 5);
  EXPECT_EQ(value_of(report, "gymnasium, if no echo says nothing").get<int>(), 0);
  EXPECT_GT(slurp(dir.at("out/run1_move0.png")).size(), 1000u);
}

TEST(Paper, Asharif2001DempstersWaysKeepFartherBayesMapIsCleaner) {
  TempDir dir;
  ASSERT_EQ(evigrid({"paper", "asharif2001", "--quick", "-o", dir.at("out")}).code, 0);
  const auto report = nlohmann::json::parse(slurp(dir.at("out/report.json")));
  const auto value = [&](const std::string& name) { return value_of(report, name); };
  EXPECT_EQ(value("routes with a way"), nlohmann::json({8, 8}));
  const auto least = value("least clearance of the ways from the true room");
  EXPECT_GT(least[0].get<double>(), least[1].get<double>());
  EXPECT_GT(least[1].get<double>(), 0.25);  // the robot's radius: nobody drives into anything
  EXPECT_LT(least[0].get<double>(), 1);
  const auto off = value("the map nearer to the ideal one");
  EXPECT_LT(off[1].get<double>(), off[0].get<double>());
  EXPECT_EQ(value("ways through the true obstacles"), nlohmann::json({0, 0}));
}

TEST(Paper, Li2006TwoOpinionsOnTheSameMap) {
  TempDir dir;
  ASSERT_EQ(evigrid({"paper", "li2006", "--quick", "-o", dir.at("out")}).code, 0);
  const auto report = nlohmann::json::parse(slurp(dir.at("out/report.json")));
  const auto precision = value_of(report, "order of precision"),
             mistaken = value_of(report, "order of the mistaken rate"),
             five = value_of(report, "cells fused by fives, as the flowchart says");
  // The engine's map of PCR5 against one cell by cell in double, from the equations, which lets readings wait.
  EXPECT_NEAR(precision[3].get<double>(), five[0].get<double>(), 0.03);
  EXPECT_NEAR(mistaken[3].get<double>(), five[1].get<double>(), 0.03);
  EXPECT_LT(five[3].get<double>(), 1.5 * five[2].get<double>());  // what decides otherwise was mostly seen too seldom
  EXPECT_GT(slurp(dir.at("out/surface.png")).size(), 10000u);
}

TEST(TurningSurface, HoldsEveryHeightAndFetchesNothing) {
  Layers l;
  l.rect = {-2, 3, 3, 2};
  l.cell_m = 0.5;
  l.planes.assign(4 * l.cells(), 0);
  std::fill_n(l.planes.begin() + 12, 6, 1.0F);      // u: nothing is known …
  l.planes[6 + 4] = 0.4F, l.planes[12 + 4] = 0.6F;  // … but m(occupied) = 0.4 of cell (1, 1)
  const std::string markup = turning_surface(l, "one");
  // 3 × 2 cells and a rim: 5 × 4 heights, all never seen (255) but that one (0.4 · 250 = 100).
  std::vector<std::byte> z(20, std::byte{255});
  z[2 * 5 + 2] = std::byte{100};
  EXPECT_NE(markup.find("z: '" + base64(z) + "'"), std::string::npos) << markup.substr(0, 600);
  EXPECT_NE(markup.find("from: ['-1', '1.5'], to: ['0.5', '2.5']"), std::string::npos);
  EXPECT_NE(markup.find("id=\"one\""), std::string::npos);
  EXPECT_EQ(markup.find("http"), std::string::npos);
  EXPECT_EQ(markup.find("src="), std::string::npos);
}

TEST(Paper, AllOfThemWithOnePageOver) {
  TempDir dir;
  const Ran ran = evigrid({"paper", "all", "--quick", "-o", dir.at("out")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string html = slurp(dir.at("out/index.html"));
  const auto index = nlohmann::json::parse(slurp(dir.at("out/index.json")));
  ASSERT_EQ(index["papers"].size(), papers().size());
  for (std::size_t i = 0; i < papers().size(); ++i) {
    const std::string name(papers()[i].name);
    EXPECT_EQ(index["papers"][i]["paper"], name);
    EXPECT_NE(html.find("href=\"" + name + "/report.html\""), std::string::npos) << name;
    const auto report = nlohmann::json::parse(slurp(dir.at("out/" + name + "/report.json")));
    std::size_t met = 0, missed = 0;
    for (const auto& f : report["findings"]) {
      if (f["aim"] == "target") ++(f["met"].get<bool>() ? met : missed);
    }
    EXPECT_EQ(index["papers"][i]["outcomes_met"], met);
    EXPECT_EQ(index["papers"][i]["outcomes_missed"], missed);
  }
}

/// A room of 8 × 7 m with a pillar, as map_server's yaml and pgm.
void write_plan(const TempDir& dir) {
  constexpr int w = 160, h = 140;
  std::string pixels(w * h, '\xfe');
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const bool rim = x < 2 || y < 2 || x >= w - 2 || y >= h - 2,
                 pillar = std::abs(x - 100) < 8 && std::abs(y - 60) < 12;
      if (rim || pillar) pixels[static_cast<std::size_t>(y * w + x)] = 0;
    }
  std::ofstream(dir.at("plan.pgm"), std::ios::binary) << "P5 " << w << " " << h << " 255\n" << pixels;
  std::ofstream(dir.at("plan.yaml")) << "image: plan.pgm\nresolution: 0.05\norigin: [-2, -1, 0]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

TEST(Paper, RunsInAPlanOfTheUsersWithoutTargets) {
  TempDir dir;
  write_plan(dir);
  for (const Paper& p : papers()) {
    const std::string name(p.name), out = dir.at(name);
    const Ran ran = evigrid({"paper", name.c_str(), "--quick", "-o", out, "--world", dir.at("plan.yaml")});
    ASSERT_EQ(ran.code, 0) << name << ": " << ran.err;
    const auto report = nlohmann::json::parse(slurp(out + "/report.json"));
    EXPECT_EQ(report["world"], dir.at("plan.yaml"));
    for (const auto& f : report["findings"]) EXPECT_NE(f["aim"], "target") << name << ": " << f["name"];
  }
}

TEST(Paper, AWorldsOptionsNeedAWorld) {
  TempDir dir;
  const Ran ran = evigrid({"paper", "hughes1992", "-o", dir.at("out"), "--start", "1,1"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("--start: is for --world"), std::string::npos) << ran.err;
}

TEST(Paper, UnknownPapersAreRefusedByName) {
  TempDir dir;
  const Ran ran = evigrid({"paper", "asimov1942", "-o", dir.at("out")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("'asimov1942' is unknown; known: hughes1992"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace evigrid::driver
