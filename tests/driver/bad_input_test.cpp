// SPDX-License-Identifier: Apache-2.0
// Bad input, as the command line's contract says: exit code 2, a message that names file and field, nothing left
// behind.
#include <gtest/gtest.h>

#include <random>

#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {
namespace {

using Names = std::set<std::string>;

struct BadInput : ::testing::Test {
  TempDir dir;
  std::string good = dir.write("good.log", flaser(180, "3.5", 1) + flaser(180, "3.5", 2));

  /// `map` with these arguments fails as it should, and the folder holds what it held before.
  void expect_refused(std::vector<std::string> arguments, const std::string& message) {
    const Names before = dir.names();
    const Ran ran = evigrid(arguments);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_TRUE(contains(ran.err, message));
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(dir.names(), before);
  }
  void expect_map_refused(const std::string& log, const std::string& message, std::vector<std::string> more = {}) {
    std::vector<std::string> all{"map", log, "-o", dir.at("new/out")};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(all, message);
  }
};

TEST_F(BadInput, GoodInputIsNotRefused) {  // or the tests below would pass for another reason
  const Ran ran = evigrid({"map", good, "-o", dir.at("new/out")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(dir.names().contains("new/out/map.png"));
}

TEST_F(BadInput, MissingFile) { expect_map_refused(dir.at("missing.log"), "missing.log: no such file"); }
TEST_F(BadInput, EmptyFile) {
  expect_map_refused(dir.write("empty.log", ""), "no usable record in " + dir.at("empty.log"));
}
TEST_F(BadInput, TruncatedPlainFile) {
  expect_map_refused(dir.write("cut.log", slurp(good).substr(0, 400)), "cut.log:1: too short");
}
TEST_F(BadInput, TruncatedGzip) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += flaser_with(180, i, fmt::format("{}", 1.5 + i * 0.37), i);
  const std::string bytes = slurp(dir.write_gz("whole.log.gz", text));
  expect_map_refused(dir.write("cut.log.gz", bytes.substr(0, bytes.size() * 2 / 3)), "cut.log.gz: truncated");
}
TEST_F(BadInput, BinaryGarbage) {
  std::mt19937 random(1);
  std::string bytes(20000, ' ');
  for (char& c : bytes) c = static_cast<char>(random());
  expect_map_refused(dir.write("junk.log", bytes), "junk.log");
  std::string text_like = bytes;
  for (char& c : text_like) c = static_cast<char>(33 + static_cast<unsigned char>(c) % 90);
  expect_map_refused(dir.write("junk2.log", text_like), "junk2.log");
}
TEST_F(BadInput, NoRangeOfUse) {
  expect_map_refused(dir.write("nan.log", flaser(180, "nan", 1)), "no reading could be used");
}
TEST_F(BadInput, PosesFarOutOrNotFinite) {
  expect_map_refused(dir.write("a.log", flaser(180, "3", 1, "nan 0 0") + flaser(180, "3", 2, "1e300 0 0")),
                     "no reading could be used");
}
TEST_F(BadInput, CellSizes) {
  for (const char* cell : {"0", "-1", "nan", "inf"}) expect_map_refused(good, "map.cell_m", {"--cell", cell});
  expect_map_refused(good, "--cell", {"--cell", "five"});
}
TEST_F(BadInput, UnknownNames) {
  expect_map_refused(good, "--rule: 'pcr7' is unknown or not built yet; known: dempster", {"--rule", "pcr7"});
  expect_map_refused(good, "model 'magic'", {"--model", "magic"});
  expect_map_refused(good, "--model: li2014 is for sonar cones", {"--model", "li2014"});
  expect_map_refused(good, "--kernel: 'mmx'", {"--kernel", "mmx"});
  expect_map_refused(good, "--executor: 'fibres'", {"--executor", "fibres"});
  expect_map_refused(good, "--format: 'rosbag'", {"--format", "rosbag"});
}
TEST_F(BadInput, NumbersOutOfRange) {
  expect_map_refused(good, "--threads: -1", {"--threads", "-1"});
  expect_map_refused(good, "sensor.max_range_m", {"--max-range", "-3"});
  expect_map_refused(good, "sensor.reliability", {"--reliability", "0"});
  expect_map_refused(good, "max_range_m", {"--cell", "0.0001"});  // 100 000 cells across
  expect_map_refused(good, "--max-image-mb", {"--max-image-mb", "0"});
}
TEST_F(BadInput, ADensePictureBeyondTheCapIsRefusedByName) {
  expect_map_refused(dir.write("far.log", flaser(180, "3", 1) + flaser(180, "3", 2, "3000 3000 0")), "masses.npy",
                     {"--max-image-mb", "100"});
}
TEST_F(BadInput, OutputThatCannotBeWritten) {
  expect_refused({"map", good, "-o", good + "/out"}, "good.log/out: cannot be written");
  expect_refused({"map", good, "-o", good}, "good.log: cannot be written");
  expect_map_refused(good, "cannot be written", {"--json", good + "/report.json"});
}
TEST_F(BadInput, TheOutputFolderIsCheckedBeforeTheLog) {
  expect_refused({"map", dir.at("missing.log"), "-o", good + "/out"}, "good.log/out");
  expect_map_refused(dir.at("missing.log"), "good.log/report.json", {"--json", good + "/report.json"});
}
TEST_F(BadInput, AnOldMapSurvivesAFailedRun) {
  dir.write("old/map.png", "precious");
  expect_refused({"map", dir.at("missing.log"), "-o", dir.at("old")}, "missing.log");
  EXPECT_EQ(slurp(dir.at("old/map.png")), "precious");
}
TEST_F(BadInput, Usage) {
  expect_refused({}, "subcommand");
  expect_refused({"fly"}, "command 'fly' is unknown; known: map, run");
  expect_refused({"map", good}, "--out");
  expect_refused({"map", good, "-o", dir.at("x"), "--speed", "9"}, "--speed");
}
TEST_F(BadInput, SceneFiles) {
  expect_refused({"run", dir.at("none.toml"), "-o", dir.at("out")}, "none.toml");
  expect_refused({"run", dir.write("a.toml", "colour = 'red'\n"), "-o", dir.at("out")}, "a.toml:1");
  expect_refused({"run", dir.write("b.toml", "[map\n"), "-o", dir.at("out")}, "b.toml:1");
  expect_refused({"run", dir.write("c.toml", ""), "-o", dir.at("out")}, "c.toml");
  expect_refused({"cast", dir.at("none.toml")}, "none.toml");
  expect_refused({"run", "-o", dir.at("out"), "--model", "beam"}, "--model: beam is for laser fans");
  expect_refused({"run", "-o", dir.at("out"), "--clear-no-return"}, "--clear-no-return");
}
TEST_F(BadInput, Combine) {
  const std::string rows = dir.write("rows.csv", "e1,o1,e2,o2\n0.5,0.6,0,0\n");
  expect_refused({"combine", "--rule", "pcr5", "--in", rows}, "rows.csv:2:o1");
  expect_refused({"combine", "--rule", "pcr5", "--in", dir.at("none.csv")}, "none.csv");
  expect_refused({"combine", "--rule", "pcr5", "--in", dir.at("")}, "is a folder");
  expect_refused({"combine", "--rule", "pcr5"}, "(standard input): is empty");
  expect_refused({"combine", "--rule", "magic", "--in", rows}, "known: dempster");
  expect_refused({"combine", "--rule", "pcr5", "--in", rows, "-o", rows + "/x"}, "cannot be written");
  expect_refused({"combine", "--rule", "pcr5", "--in", rows, "--sources", "3"}, "rows.csv:1:e3");
  expect_refused({"combine", "--rule", "pcr5", "--in", rows, "--sources", "1"}, "--sources: 1");
  for (const char* command : {"run", "compare"}) {
    const char* option = std::string(command) == "run" ? "--rule" : "--rules";
    expect_refused({command, "default", "-o", dir.at("o"), option, "disjunctive"}, "stay unknown");
    expect_refused({command, "default", "-o", dir.at("o"), option, "disjunctive"}, "use it with combine");
  }
}
TEST_F(BadInput, Model) {
  expect_refused({"model", "magic", "--reading", "1", "--at", "1,0"}, "known: hughes1992");
  expect_refused({"model", "li2014", "--reading", "1", "--at", "one"}, "--at: 'one'");
  expect_refused({"model", "li2014", "--reading", "1"}, "--at");
  expect_refused({"model", "li2014", "--reading", "77", "--at", "1,0"}, "--reading: 77");
  expect_refused({"model", "li2014", "--reading", "nan", "--at", "1,0"}, "--reading: nan");
  expect_refused({"model", "li2014", "--reading", "1", "--at", "1,0", "--aperture", "0"}, "aperture");
  expect_refused({"model", "li2014", "--reading", "1", "--at", "1,0", "--sensor", "1"}, "--revision");
}
TEST_F(BadInput, AListTakesNoPositionalWord) {
  const std::vector<std::string> end{good, "-o", dir.at("out")};
  const auto expect_mapped = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "map");
    words.insert(words.end(), end.begin(), end.end());
    const Ran ran = evigrid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  expect_mapped({"--sensors", "FLASER"});
  expect_mapped({"--sensors", "FLASER,FLASER", "--sensors", "FLASER"});
  expect_mapped({"--param", "beam.empty=0.5", "--param", "beam.occupied=0.7"});
  expect_mapped({"--contextual", "0.9,0.8"});
  expect_mapped({"--rule", "bayes", "--bayes-limits", "0.01,0.99"});
  const std::string csv = dir.at("cells.csv");
  for (const std::vector<std::string>& list : {std::vector<std::string>{"--planes", "e,o"}, {"--region", "0,0,2,2"}}) {
    const Ran ran = evigrid({"export", list[0], list[1], dir.at("out"), "-o", csv});
    EXPECT_EQ(ran.code, 0) << ran.err;
  }
  EXPECT_EQ(evigrid({"export", "--region", "0", "0", "2", "2", dir.at("out"), "-o", csv}).code, 0);
  expect_refused({"compare", "--topics", "/scan", dir.at("none.bag"), "-o", dir.at("no")}, "none.bag");
  expect_refused({"cycle", "--sweep", "robots=1", "stray"}, "stray");
}
TEST_F(BadInput, OptionsOfBagsAreForBags) {
  expect_map_refused(good, "--topics: is for ROS bags", {"--topics", "/scan"});
  expect_map_refused(good, "--fixed-frame: is for ROS bags", {"--fixed-frame", "odom"});
  expect_refused({"log", good, "--base-frame", "base"}, "--base-frame: is for ROS bags");
  expect_refused({"compare", "default", "-o", dir.at("o"), "--topics", "/scan"}, "--topics: is for ROS bags");
  expect_refused({"compare", "-o", dir.at("o"), "--topics", "/scan"}, "--topics: is for ROS bags");
}
TEST_F(BadInput, OptionsOfScenesAreNotForLogs) {
  for (const std::vector<std::string>& one : {std::vector<std::string>{"--start", "1,1"},
                                              {"--seed", "3"},
                                              {"--resolution", "0.1"},
                                              {"--height", "1"},
                                              {"--up", "x"}})
    expect_refused({"compare", good, "-o", dir.at("o"), one[0], one[1]}, one[0] + ": is for ");
}
TEST_F(BadInput, AnEmptyValueIsNoValue) {  // mostly a variable of the shell that was not set
  expect_refused({"cycle", "--replay", ""}, "--replay: is empty");
  expect_refused({"run", "", "-o", dir.at("o")}, "SCENE: is empty");
  expect_refused({"run", "--world", "", "-o", dir.at("o")}, "--world: is empty");
  expect_refused({"export", good, "-o", "", "--format", "csv"}, "--out: is empty");
  expect_map_refused(good, "--max-range: is empty", {"--max-range", ""});
  expect_map_refused(good, "--threads: is empty", {"--threads", ""});
}
TEST_F(BadInput, WholeNumbersAreTakenAsTheyStand) {
  expect_refused({"run", "-o", dir.at("o"), "--seed", "99999999999999999999"}, "--seed: 99999999999999999999 is too");
  expect_refused({"cycle", "--robots", "1e3"}, "--robots: '1e3' is no whole number");
  expect_refused({"train", good, "-o", dir.at("o"), "--examples", "-1"}, "--examples: '-1' is no whole number from 0");
  std::string head = "e1,o1", row = "0,0";
  for (int source = 2; source <= 8; ++source) head += fmt::format(",e{0},o{0}", source), row += ",0,0";
  const std::string rows = dir.write("rows.csv", head + "\n" + row + "\n");
  expect_refused({"combine", "--rule", "murphy", "--in", rows, "--sources", "010"}, "e9: the column is missing");
  EXPECT_EQ(evigrid({"combine", "--rule", "murphy", "--in", rows, "--sources", "+08"}).code, 0);
}
TEST_F(BadInput, FoldersAndMissingFilesByName) {
  const std::string folder = dir.at(""), none = dir.at("none"), out = dir.at("o");
  expect_refused({"run", "-o", out, "--revision", folder}, "is a folder");
  expect_refused({"run", "-o", out, "--revision", none}, "none: cannot be read: No such file");
  expect_refused({"run", "-o", out, "--world", none}, "none: there is no such file");
  expect_refused({"run", "-o", out, "--world", folder}, ": is no file");
  expect_refused({"show", none}, "none: cannot be opened: No such file");
  expect_refused({"cycle", "--replay", folder}, "is a folder");
  expect_map_refused(good, "good.log exists already; --resume", {"--journal", good});
}
TEST_F(BadInput, OddNumbersAndOptionsWithoutUse) {
  expect_refused({"model", "li2014", "--reading", "1", "--at", "nan,0"}, "--at: 'nan,0'");
  expect_refused({"model", "li2014", "--reading", "1", "--at", "-1,0"}, "--at: '-1,0'");
  expect_refused({"model", "beam", "--reading", "1", "--at", "1,0", "--aperture", "9"}, "--aperture: is for cones");
  expect_refused({"show", good, "--columns", "-1"}, "--columns: -1");
  expect_refused({"calibrate", good, "--bin", "1e300"}, "--bin: 1e+300 is above 1000 m");
  expect_refused({"merge", good, good, "-o", dir.at("o"), "--reliability", "2"}, "--reliability: 2 is not within");
  expect_refused({"cycle", "--replay", good, "--save-map"}, "--save-map: needs -o");
}
TEST_F(BadInput, AFullStandardOutputIsTold) {
  for (const std::string command : {"--help", "map --help", "--version", "cast", "info"})
    EXPECT_EQ(std::system(("'" EVIGRID_PROGRAM "' " + command + " >/dev/full 2>/dev/null").c_str()), 2 << 8) << command;
}
TEST_F(BadInput, ARegionIsOfAMap) { expect_refused({"info", "--region=0,0,1,1"}, "--region: is for a MAP"); }

}  // namespace
}  // namespace evigrid::driver
