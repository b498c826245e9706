// SPDX-License-Identifier: Apache-2.0
// evigrid diff: figures against a plain loop over single cells of the two maps, and what cannot be compared.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "diff/map_difference.hpp"
#include "driver/decoded_png.hpp"
#include "evigrid/io.hpp"
#include "evigrid/readout.hpp"
#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

std::string mapped(const TempDir& dir, const std::string& name, const std::string& range,
                   std::vector<std::string> more) {
  std::vector<std::string> all{"map", dir.write(name + ".log", flaser(180, range, 3)), "-o", dir.at(name)};
  all.insert(all.end(), more.begin(), more.end());
  const Ran ran = evigrid(all);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return dir.at(name);
}

TEST(Diff, FiguresAreThoseOfTheCells) {
  const TempDir dir;
  const std::string a = mapped(dir, "a", "3.5", {"--cell", "0.1"}), b = mapped(dir, "b", "2.5", {"--cell", "0.1"});
  const Ran ran = evigrid({"diff", a, b, "--json", "-", "-o", dir.at("d.png")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json got = Json::parse(ran.out);
  const Map ma = load(a + "/map.evigrid"), mb = load(b + "/map.evigrid");
  // Every cell of a square that holds both, one by one.
  std::uint64_t seen_a = 0, seen_b = 0, both = 0, bits = 0, table[3][3] = {};
  double sum = 0, largest = 0;
  CellIndex at{};
  for (std::int64_t y = -60; y < 60; ++y) {
    for (std::int64_t x = -60; x < 60; ++x) {
      const Mass p = ma.mass({x, y}), q = mb.mass({x, y});
      const bool in_p = p.u != 1, in_q = q.u != 1;
      seen_a += in_p, seen_b += in_q, both += in_p && in_q;
      if (!in_p && !in_q) continue;
      bits += in_p && in_q && p.e == q.e && p.o == q.o && p.u == q.u;
      ++table[static_cast<int>(decide(p))][static_cast<int>(decide(q))];
      const double d = std::abs(double(q.o) - double(p.o));
      sum += d;
      if (d > largest) largest = d, at = {x, y};
    }
  }
  ASSERT_GT(both, 100U);
  ASSERT_GT(table[1][2] + table[2][1], 0U);
  EXPECT_EQ(got["cells_seen"]["a"], seen_a);
  EXPECT_EQ(got["cells_seen"]["b"], seen_b);
  EXPECT_EQ(got["cells_seen"]["both"], both);
  EXPECT_EQ(got["cells_with_equal_bits"], bits);
  EXPECT_EQ(got["same"], false);
  const char* names[] = {"unknown", "empty", "occupied"};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_EQ(got["decisions_a_b"][names[i]][names[j]], table[i][j]) << i << j;
  }
  const double decided = static_cast<double>(table[1][1] + table[2][2] + table[1][2] + table[2][1]);
  EXPECT_DOUBLE_EQ(got["agreement"].get<double>(), static_cast<double>(table[1][1] + table[2][2]) / decided);
  EXPECT_DOUBLE_EQ(got["contradict"].get<double>(), static_cast<double>(table[1][2] + table[2][1]) / decided);
  const Json& o = got["difference"]["o"];
  EXPECT_NEAR(o["mean_abs"].get<double>(), sum / static_cast<double>(seen_a + seen_b - both), 1e-12);
  EXPECT_DOUBLE_EQ(o["largest"].get<double>(), largest);
  EXPECT_EQ(o["largest_at_cell"], Json({at.x, at.y}));
  EXPECT_GT(decode_png(slurp(dir.at("d.png"))).width, 900);
}

TEST(Diff, AMapAndItself) {
  const TempDir dir;
  const std::string a = mapped(dir, "a", "3.5", {});
  const Ran text = evigrid({"diff", a, a + "/map.evigrid"});
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_TRUE(contains(text.out, "the same: all")) << text.out;
  const Json got = Json::parse(evigrid({"diff", a, a, "--json", "-"}).out);
  EXPECT_EQ(got["same"], true);
  EXPECT_EQ(got["agreement"], 1.0);
  EXPECT_EQ(got["difference"]["betp"]["largest"], 0.0);
}

TEST(Diff, TurnedOverItIsItsMirror) {
  const TempDir dir;
  const std::string a = mapped(dir, "a", "3.5", {}), b = mapped(dir, "b", "2.9", {"--rule", "dempster"});
  const Json ab = Json::parse(evigrid({"diff", a, b, "--json", "-"}).out);
  const Json ba = Json::parse(evigrid({"diff", b, a, "--json", "-"}).out);
  for (const char* mass : {"e", "o", "u", "betp"}) {
    EXPECT_DOUBLE_EQ(ab["difference"][mass]["mean"].get<double>(), -ba["difference"][mass]["mean"].get<double>());
    EXPECT_EQ(ab["difference"][mass]["largest"], ba["difference"][mass]["largest"]);
  }
  EXPECT_EQ(ab["decisions_a_b"]["empty"]["occupied"], ba["decisions_a_b"]["occupied"]["empty"]);
  EXPECT_TRUE(contains(evigrid({"diff", a, b}).out, "the rules differ"));
}

TEST(Diff, RefusesWhatCannotLieOnEachOther) {
  const TempDir dir;
  const std::string a = mapped(dir, "a", "3.5", {}), b = mapped(dir, "b", "3.5", {"--cell", "0.1"});
  const Ran cells = evigrid({"diff", a, b, "-o", dir.at("d.png")});
  EXPECT_EQ(cells.code, 2);
  EXPECT_TRUE(contains(cells.err, "cells of 0.05 m")) << cells.err;
  EXPECT_TRUE(contains(cells.err, b + "/map.evigrid of 0.1 m")) << cells.err;
  EXPECT_FALSE(std::filesystem::exists(dir.at("d.png")));
  const Ran missing = evigrid({"diff", a, dir.at("none")});
  EXPECT_EQ(missing.code, 2);
  EXPECT_TRUE(contains(missing.err, dir.at("none"))) << missing.err;
  const Ran text = evigrid({"diff", a, dir.write("x.evigrid", "no map")});
  EXPECT_EQ(text.code, 2);
  EXPECT_TRUE(contains(text.err, "x.evigrid")) << text.err;
}

}  // namespace
}  // namespace evigrid::driver
