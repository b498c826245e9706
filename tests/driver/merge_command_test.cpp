// SPDX-License-Identifier: Apache-2.0
// evigrid merge, and the journal of evigrid map, as a user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "evigrid/evigrid.hpp"
#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

std::string mapped(const TempDir& dir, const std::string& name, const std::string& range,
                   const std::string& cell = "0.1") {
  std::vector<std::string> all{
      "map", dir.write(name + ".log", flaser(180, range, 3)), "-o", dir.at(name), "--cell", cell, "--rule", "pcr5"};
  const Ran ran = evigrid(all);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return dir.at(name);
}

TEST(MergeCommand, IsTheLibrarysMergeInTheOrderGiven) {
  const TempDir dir;
  const std::string a = mapped(dir, "a", "3.5"), b = mapped(dir, "b", "2.5"), c = mapped(dir, "c", "4.5");
  const Ran ran = evigrid({"merge", a, b, c, "-o", dir.at("m"), "--pose", "1.5,-0.7,0", "--pose=-0.25,0.1,30",
                           "--reliability", "0.9", "--reliability", "0.5", "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json report = Json::parse(ran.out);
  Map wanted = load(a + "/map.evigrid");
  Map mb = load(b + "/map.evigrid"), mc = load(c + "/map.evigrid");
  merge(wanted, mb.view(), {{1.5, -0.7, 0}, 0.9});
  merge(wanted, mc.view(), {{-0.25, 0.1, 30 * M_PI / 180}, 0.5});
  EXPECT_EQ(load(dir.at("m") + "/map.evigrid").hash(), wanted.hash());
  ASSERT_EQ(report["merged"].size(), 2U);
  EXPECT_TRUE(report["merged"][0]["aligned"]);
  EXPECT_FALSE(report["merged"][1]["aligned"]);
  for (const char* file : {"map.png", "map.pgm", "map.yaml", "masses.npy", "report.json"})
    EXPECT_TRUE(std::filesystem::exists(dir.at("m") + "/" + file)) << file;
}

TEST(MergeCommand, BadInputIsNamedAndLeavesNothing) {
  const TempDir dir;
  const std::string a = mapped(dir, "a", "3.5"), b = mapped(dir, "b", "2.5");
  const std::string other = mapped(dir, "other", "2.5", "0.2");
  const auto refused = [&](std::vector<std::string> args, const std::string& why) {
    args.insert(args.begin(), "merge");
    args.insert(args.end(), {"-o", dir.at("none")});
    const Ran ran = evigrid(args);
    EXPECT_EQ(ran.code, 2) << why;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(dir.at("none")));
  };
  refused({a}, "at least two");
  refused({a, other}, "different sizes");
  refused({a, b, "--pose", "1,2"}, "--pose: '1,2'");
  refused({a, b, "--pose", "1,2,x"}, "--pose: '1,2,x'");
  refused({a, b, "--pose", "1,2,0", "--pose", "1,2,0"}, "given 2 times, for 1");
  refused({a, b, "--reliability", "1.5"}, "reliability");
  refused({a, dir.at("missing")}, "missing");
}

std::string drive(const std::string& range) {
  std::string out;
  for (int i = 0; i < 200; ++i) out += flaser(180, range, i, fmt::format("{} 2 0.5", 0.01 * i));
  return out;
}

TEST(MapJournal, ARunThatEndedEarlyGoesOn) {
  const TempDir dir;
  const std::string log = dir.write("drive.log", drive("3.5")), journal = dir.at("j");
  const auto run = [&](const std::string& out, std::vector<std::string> more) {
    std::vector<std::string> all{"map", log, "-o", dir.at(out), "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return evigrid(all);
  };
  const Ran plain = run("plain", {}), first = run("first", {"--journal", journal});
  ASSERT_EQ(plain.code, 0) << plain.err;
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string hash = Json::parse(plain.out)["map_hash"];
  EXPECT_EQ(Json::parse(first.out)["map_hash"], hash);
  const auto whole = std::filesystem::file_size(journal);
  EXPECT_EQ(Json::parse(first.out)["journal"]["bytes"], whole);
  EXPECT_EQ(RevisableMap::resume(journal).map().hash(), load(dir.at("plain") + "/map.evigrid").hash());
  std::filesystem::resize_file(journal, whole / 2 + 5);  // as a killed run leaves it
  const Ran resumed = run("resumed", {"--journal", journal, "--resume"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const Json report = Json::parse(resumed.out);
  EXPECT_EQ(report["map_hash"], hash);
  EXPECT_GT(report["journal"]["scans_resumed"], 50);
  EXPECT_LT(report["journal"]["scans_resumed"], 150);
  EXPECT_GT(report["journal"]["bytes_dropped"], 0);
  EXPECT_EQ(std::filesystem::file_size(journal), whole);

  Ran bad = run("bad", {"--journal", journal});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("exists"), std::string::npos) << bad.err;
  bad = run("bad", {"--journal", journal, "--resume", "--rule", "dempster"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("other parameters"), std::string::npos) << bad.err;
  dir.write("drive.log", drive("3.25"));
  bad = run("bad", {"--journal", journal, "--resume"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("is not scan 0"), std::string::npos) << bad.err;
  EXPECT_EQ(run("bad", {"--resume"}).code, 2);
}

}  // namespace
}  // namespace evigrid::driver
