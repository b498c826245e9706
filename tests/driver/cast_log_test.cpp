// SPDX-License-Identifier: Apache-2.0
// The CSV of `evigrid cast --sensors` is a log: the map of it is the map of the run.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "error.hpp"
#include "log/readers.hpp"
#include "log/sensor_line.hpp"
#include "log/summary.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

Log read_text(const std::string& text) {
  const std::string_view bytes[] = {text};
  return read_log_bytes("auto", bytes);
}
std::string error_of(const std::string& text) {
  try {
    (void)read_text(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(CastLog, MapsToTheMapOfTheRun) {
  const TempDir dir;
  for (const std::string scene : {"default", "li2014_drift", "delafosse2007"}) {
    const Ran run = evigrid({"run", scene, "-o", dir.at("run"), "--cell", "0.1", "--rule", "pcr5", "--json", "-"});
    ASSERT_EQ(run.code, 0) << run.err;
    ASSERT_EQ(evigrid({"cast", scene, "--sensors", "-o", dir.at("c.csv")}).code, 0);
    const Ran map =
        evigrid({"map", dir.at("c.csv"), "-o", dir.at("map"), "--cell", "0.1", "--rule", "pcr5", "--json", "-"});
    ASSERT_EQ(map.code, 0) << map.err;
    const Json a = Json::parse(run.out), b = Json::parse(map.out);
    EXPECT_EQ(b["format"], "cast");
    EXPECT_EQ(a["map_hash"], b["map_hash"]) << scene;
    EXPECT_EQ(a["readings_used"], b["readings_used"]) << scene;
  }
}

TEST(CastLog, ASensorLineIsTheSensor) {
  LogSensor laser;
  laser.kind = "laser";
  laser.name = "front";
  laser.stated = true;
  Sensor& s = laser.sensor;
  s.model = Model::beam;
  s.T_robot_sensor = {0.1, -1.0 / 3, 2};
  s.min_range_m = 0.02, s.max_range_m = 29.99, s.no_return_m = 30.5;
  s.beams = 361, s.first_beam_rad = -1.5, s.beam_step_rad = 0.0087;
  s.reliability = 0.7, s.reliability_if_empty = 0.6, s.decay_s = 3;
  s.dependence = Dependence::weighted, s.weight_exponent = 0.25;
  s.clear_no_return = true;
  ASSERT_TRUE(set_model_param(s, Model::beam, "empty", 0.55));
  const std::string line = sensor_line(7, laser);
  const auto back = parse_sensor_line(line, 7);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, "front");
  EXPECT_EQ(sensor_line(7, *back), line);
  EXPECT_EQ(back->sensor.T_robot_sensor.y_m, s.T_robot_sensor.y_m);
  EXPECT_EQ(back->sensor.beam.empty, 0.55);
  EXPECT_EQ(back->sensor.dependence, Dependence::weighted);
  EXPECT_TRUE(back->stated);
  EXPECT_FALSE(parse_sensor_line("# a note", 0));
}

constexpr const char* kHead = "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m,beam\n";

TEST(CastLog, ScansAreStepsAndBeamsFollowOneAnother) {
  const Log log = read_text("# sensor 0 kind=sonar\n# sensor 1 kind=laser model=beam beams=3 beam_step_rad=0.1\n" +
                            std::string(kHead) +
                            "0,9007199254740993,1,2,0.5,0,inf,0\n"
                            "0,9007199254740993,1,2,0.5,1,1,0\n0,9007199254740993,1,2,0.5,1,-inf,1\n"
                            "0,9007199254740993,1,2,0.5,1,3,2\n"
                            "1,9007199254740994,1,2,0.5,1,4,0\n1,9007199254740994,1,2,0.5,1,5,2\n"
                            "1,5,1,2,0.5,2,5,0\n1,5,1,2,0.5,0,5,1\n1,5.5,1,2,0.5,0,5,0\n");
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].stamp_ns, 9007199254740993);  // more than a double holds
  ASSERT_EQ(log.scans[0].count, 2U);
  EXPECT_EQ(log.readings[1].count, 3U);
  EXPECT_EQ(log.ranges_m[2], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(log.malformed.at("wrong beam"), 2U);
  EXPECT_EQ(log.malformed.at("unknown sensor"), 1U);
  EXPECT_EQ(log.malformed.at("bad number"), 1U);
}

TEST(CastLog, TimesWhoseDifferenceNeedsMoreThan64BitsAreNone) {
  const Log log = read_text("# sensor 0 kind=sonar\n" + std::string(kHead) +
                            "0,-9223372036854775808,1,2,0.5,0,1,0\n1,9223372036854775807,1,2,0.5,0,1,0\n"
                            "2,4499999999999999999,1,2,0.5,0,1,0\n3,-4499999999999999999,1,2,0.5,0,1,0\n");
  EXPECT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.malformed.at("bad number"), 2U);
  EXPECT_EQ(summarise(log)["time"]["span_s"], 9e9);
}

TEST(CastLog, WithoutSensorsItSaysHowToWriteThem) {
  const std::string row = "0,0,1,2,0.5,0,1,0\n";
  EXPECT_TRUE(contains(error_of(kHead + row), "evigrid cast --sensors")) << error_of(kHead + row);
  const auto refused = [&](const std::string& line, const std::string& why) {
    const std::string error = error_of("# a note\n" + line + "\n" + kHead + row);
    EXPECT_TRUE(contains(error, why)) << error;
    EXPECT_TRUE(contains(error, ":2: ")) << error;
  };
  refused("# sensor 1 kind=sonar", "must be 0");
  refused("# sensor 0 kind=sonar colour=3", "colour: is no key");
  refused("# sensor 0 kind=sonar x_m=3 x_m=3", "x_m: is given twice");
  refused("# sensor 0 kind=sonar x_m=left", "x_m: is no finite number");
  refused("# sensor 0 model=radar", "model: no such model");
  refused("# sensor 0 aperture_rad=7", "aperture_rad is 7");
  refused("# sensor 0 beams=1e9", "beams: is no number of beams");
}

TEST(CastLog, ASensorThatClearsWithoutReturnDoes) {
  const TempDir dir;
  const std::string rows = std::string(kHead) + "0,0,1,2,0,0,inf,0\n0,0,1,2,0,0,inf,1\n0,0,1,2,0,0,3,2\n";
  const auto cells = [&](const std::string& key) {
    const std::string log = dir.write(
        "log.csv", "# sensor 0 kind=laser model=beam beams=3 beam_step_rad=0.02 max_range_m=8" + key + "\n" + rows);
    const Ran ran = evigrid({"map", log, "-o", dir.at("out"), "--json", "-"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["cells_updated"].get<int>();
  };
  EXPECT_GT(cells(" clear_no_return=1"), 2 * cells(""));
}

}  // namespace
}  // namespace evigrid::driver
