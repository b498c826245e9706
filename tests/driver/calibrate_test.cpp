// SPDX-License-Identifier: Apache-2.0
// Errors of range finders: figures by hand, a sensor of known faults, and the command.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "calibrate/statistics.hpp"
#include "error.hpp"
#include "log/readers.hpp"
#include "log_samples.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

Log truth_log(const std::vector<Sample>& samples) {
  std::string text = ",time,range,velocity_command,sonar1,sonar2\n";
  for (std::size_t i = 0; i < samples.size(); ++i) {
    text += fmt::format("{},{},{:.9g},0,{:.9g},1\n", i, i, samples[i].truth_m, samples[i].reading_m);
  }
  const std::string_view bytes[] = {text};
  return read_log_bytes("enmt482", bytes);
}

TEST(Calibrate, MedianAndMadByHand) {
  std::vector<double> odd{5, 1, 3}, even{4, 1, 3, 2}, none;
  EXPECT_DOUBLE_EQ(median(odd), 3);
  EXPECT_DOUBLE_EQ(median(even), 2.5);
  EXPECT_DOUBLE_EQ(median(none), 0);
  // Errors −1, 0, 1, 2, 30 cm and one missing echo, one error code, in one bin.
  const Log log = truth_log({{1, 0.99}, {1, 1}, {1, 1.01}, {1, 1.02}, {1, 1.3}, {1, 8}, {1, 0.01}});
  const Calibration c = calibrate(log, {}).at(0);
  EXPECT_EQ(c.sensor, "sonar1");
  EXPECT_EQ(c.all.samples, 7u);
  EXPECT_EQ(c.all.echoes(), 5u);
  EXPECT_EQ(c.all.no_return, 1u);
  EXPECT_EQ(c.all.unusable, 1u);
  EXPECT_EQ(c.all.outliers, 1u);
  EXPECT_EQ(c.all.off, 3u);
  EXPECT_NEAR(c.all.bias_m, 0.01, 1e-6);
  EXPECT_NEAR(c.all.sigma_m, 1.4826 * 0.01, 1e-6);
  EXPECT_NEAR(c.reliability.value(), 0.8, 1e-9);
  EXPECT_EQ(c.noise.bins, 0u);  // five echoes say nothing about spread
  ASSERT_EQ(c.bins.size(), 1u);
  EXPECT_DOUBLE_EQ(c.bins[0].from_m, 1);
}

TEST(Calibrate, ASensorOfKnownFaultsIsFound) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Sample> samples;
  for (int i = 0; i < 40000; ++i) {
    const double truth = 0.5 + 3 * uniform(random), dice = uniform(random);
    const double sigma = 0.004 + 0.01 * truth;
    samples.push_back({truth, dice < 0.05 ? 8.0 : dice < 0.08 ? truth + 1.5 : truth - 0.03 + sigma * gauss(random)});
  }
  const Calibration c = calibrate(truth_log(samples), {}).at(0);
  EXPECT_NEAR(c.all.no_return_share(), 0.05, 0.005);
  EXPECT_NEAR(c.reliability.value(), 1 - 0.03 / 0.95, 0.005);
  EXPECT_NEAR(c.noise.ratio, 0.01, 0.001);  // 3 % outliers widen the MAD by 4 %
  EXPECT_NEAR(c.noise.sigma_m, 0.004, 0.001);
  for (const RangeBin& bin : c.bins) EXPECT_NEAR(bin.stats.bias_m, -0.03, 0.004);
}

TEST(Calibrate, NoisePartsAreNeverNegative) {
  std::vector<Sample> shrinking;  // spread falls with range
  for (int i = 0; i < 4000; ++i) {
    const double truth = 0.5 + 0.0005 * i;
    shrinking.push_back({truth, truth + (i % 2 == 0 ? 1 : -1) * 0.02 * (3 - truth)});
  }
  const NoiseFit falling = calibrate(truth_log(shrinking), {}).at(0).noise;
  EXPECT_EQ(falling.ratio, 0);
  EXPECT_GT(falling.sigma_m, 0);
  for (Sample& s : shrinking)
    s.reading_m = s.truth_m + (s.reading_m > s.truth_m ? 1 : -1) * 0.01 * s.truth_m * s.truth_m;
  const NoiseFit rising = calibrate(truth_log(shrinking), {}).at(0).noise;
  EXPECT_EQ(rising.sigma_m, 0);
  EXPECT_GT(rising.ratio, 0);
}

TEST(Calibrate, BadLimitsAndLogsAreRefused) {
  const Log log = truth_log({{1, 1}});
  EXPECT_THROW((void)calibrate(log, {.bin_m = 0}), InputError);
  EXPECT_THROW((void)calibrate(log, {.bin_m = std::nan("")}), InputError);
  EXPECT_THROW((void)calibrate(log, {.outlier_m = -1}), InputError);
  EXPECT_THROW((void)calibrate(Log{}, {}), InputError);
}

TEST(CalibrateCommand, WritesFiguresAndPicture) {
  const TempDir dir;
  std::string text;
  for (const FormatSample& sample : format_samples()) {
    if (sample.format == "enmt482") text = sample.text();
  }
  const std::string log = dir.write("e.csv", text);
  const Ran ran = evigrid({"calibrate", log, "-o", dir.at("out"), "--json", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json r = Json::parse(ran.out);
  EXPECT_EQ(r["sensors"][0]["all"]["samples"], 3);
  EXPECT_NEAR(r["sensors"][0]["all"]["bias_m"].get<double>(), 0.01, 1e-6);
  EXPECT_EQ(slurp(dir.at("out/calibration.json")), ran.out);
  EXPECT_TRUE(starts_with(slurp(dir.at("out/calibration.png")), "\x89PNG"));
  const Ran table = evigrid({"calibrate", log});
  EXPECT_TRUE(contains(table.out, "suggested: reliability = 1.000"));
}

TEST(CalibrateCommand, OfASensorWithoutAnEchoNothingIsSuggested) {
  const TempDir dir;
  const std::string log =
      dir.write("e.csv", ",time,range,velocity_command,sonar1,sonar2\n0,0,1,0,8,1\n1,1,1,0,8.0,1\n2,2,1,0,nan,1\n");
  const Ran ran = evigrid({"calibrate", log, "--json", dir.at("c.json")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(contains(ran.out, "not a single echo: nothing can be suggested"));
  EXPECT_TRUE(contains(ran.out, "suggested: reliability = 1.000"));  // of sonar2
  const Json r = Json::parse(slurp(dir.at("c.json")));
  EXPECT_TRUE(r["sensors"][0]["suggested"].is_null());
  EXPECT_EQ(r["sensors"][1]["suggested"]["reliability"], 1.0);
}

TEST(CalibrateCommand, RefusesWhatHoldsNoTruth) {
  const TempDir dir;
  const std::string log = dir.write("a.log", flaser(180, "3", 1));
  const Ran ran = evigrid({"calibrate", log, "-o", dir.at("out")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_TRUE(contains(ran.err, "format carmen holds no true ranges"));
  EXPECT_FALSE(dir.names().contains("out"));
}

}  // namespace
}  // namespace evigrid::driver
