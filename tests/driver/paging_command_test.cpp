// SPDX-License-Identifier: Apache-2.0
// Maps larger than --memory-mb by --page-dir, and what is said without it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "driver/temp_dir.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

/// A laser in six places half a kilometre apart, a call's scans in each.
std::string far_apart() {
  std::string log;
  for (int scan = 0; scan < 6 * 128; ++scan) {
    std::string ranges;
    for (int beam = 0; beam < 180; ++beam) ranges += fmt::format(" {:.2f}", 1.5 + 0.005 * ((scan * 7 + beam) % 100));
    const double x = 500.0 * (scan / 128);
    log += fmt::format("FLASER 180{} {} 0 0 {} 0 0 {:.1f} h {:.1f}\n", ranges, x, x, 0.1 * scan, 0.1 * scan);
  }
  return log;
}

TEST(PageDir, TheMapIsTheSameAndWithoutItTheCapRefuses) {
  const TempDir dir;
  const std::string log = dir.write("far.log", far_apart());
  const auto map = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"map", log, "-o", dir.at("out"), "--json", "-", "--max-image-mb", "4096"};
    all.insert(all.end(), more.begin(), more.end());
    return evigrid(all);
  };
  const Ran full = map({"--memory-mb", "1"});
  EXPECT_EQ(full.code, 2);
  EXPECT_NE(full.err.find("--page-dir"), std::string::npos) << full.err;
  const Ran lost = map({"--memory-mb", "1", "--page-dir", dir.at("nowhere")});
  EXPECT_EQ(lost.code, 2);
  EXPECT_NE(lost.err.find(dir.at("nowhere")), std::string::npos) << lost.err;
  EXPECT_EQ(map({"--memory-mb", "0"}).code, 2);

  const Ran roomy = map({}), paged = map({"--memory-mb", "1", "--page-dir", dir.path().string()});
  ASSERT_EQ(roomy.code, 0) << roomy.err;
  ASSERT_EQ(paged.code, 0) << paged.err;
  const Json a = Json::parse(roomy.out), b = Json::parse(paged.out);
  EXPECT_EQ(a["map_hash"], b["map_hash"]);
  EXPECT_FALSE(a.contains("paged_bytes"));
  EXPECT_GT(b["paged_bytes"], 0);
  EXPECT_LE(b["memory_bytes"], 1 << 20);
  // The saved map names a cap that it does not fit under; whoever opens it takes his own.
  EXPECT_EQ(evigrid({"info", dir.at("out")}).code, 0);
}

TEST(PageDir, AFleetOnALittleMemory) {
  const TempDir dir;
  const auto cycle = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"cycle", "--robots", "12", "--grid", "1024", "--cycles", "4", "--warmup", "0"};
    all.insert(all.end(), more.begin(), more.end());
    return evigrid(all);
  };
  const Ran full = cycle({"--memory-mb", "3"});
  EXPECT_EQ(full.code, 2);
  EXPECT_NE(full.err.find("--page-dir takes more"), std::string::npos) << full.err;
  // Scan by scan what one call writes fits.
  const std::vector<std::string> by_scan{"--policy", "backlog", "--slice", "1", "--json", "-"};
  std::vector<std::string> on_little = by_scan;
  on_little.insert(on_little.end(), {"--memory-mb", "3", "--page-dir", dir.path().string()});
  const Ran roomy = cycle(by_scan), paged = cycle(on_little);
  ASSERT_EQ(roomy.code, 0) << roomy.err;
  ASSERT_EQ(paged.code, 0) << paged.err;
  const Json a = Json::parse(roomy.out), b = Json::parse(paged.out);
  EXPECT_GT(b["paged_bytes"], 0);
  EXPECT_EQ(a["map_hash"], b["map_hash"]);
}

TEST(PageDir, ACycleThatDoesNotFitAtOnceIsFusedInParts) {
  const TempDir dir;
  const auto cycle = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"cycle", "--robots", "12", "--grid", "1024", "--cycles",
                                 "4",     "--warmup", "0",  "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return evigrid(all);
  };
  const Ran roomy = cycle({}), paged = cycle({"--memory-mb", "3", "--page-dir", dir.path().string()});
  ASSERT_EQ(roomy.code, 0) << roomy.err;
  ASSERT_EQ(paged.code, 0) << paged.err;
  EXPECT_EQ(Json::parse(roomy.out)["map_hash"], Json::parse(paged.out)["map_hash"]);
}

TEST(PageDir, ALogIsFusedAgainOnALittleMemory) {
  const TempDir dir;
  const std::string log = dir.at("scans.evilog");
  const Ran run = evigrid(
      {"cycle", "--robots", "12", "--grid", "1024", "--cycles", "4", "--warmup", "0", "--log", log, "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto again = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"cycle", "--replay", log, "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return evigrid(all);
  };
  const Ran full = again({"--memory-mb", "3"});
  EXPECT_EQ(full.code, 2);
  EXPECT_NE(full.err.find("--page-dir"), std::string::npos) << full.err;
  const Ran lost = again({"--page-dir", dir.at("nowhere")});
  EXPECT_EQ(lost.code, 2);
  EXPECT_NE(lost.err.find("--page-dir"), std::string::npos) << lost.err;
  EXPECT_NE(lost.err.find(dir.at("nowhere")), std::string::npos) << lost.err;
  const Ran paged = again({"--memory-mb", "3", "--page-dir", dir.path().string()});
  ASSERT_EQ(paged.code, 0) << paged.err;
  const Json r = Json::parse(paged.out);
  EXPECT_EQ(r["map_hash"], Json::parse(run.out)["map_hash"]);
  EXPECT_GT(r["paged_bytes"], 0);
  EXPECT_LE(r["memory_bytes"], 3 << 20);
}

}  // namespace
}  // namespace evigrid::driver
