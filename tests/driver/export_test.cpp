// SPDX-License-Identifier: Apache-2.0
// evigrid export and --region: every format read back by other means than the writer's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bag/bag.hpp"
#include "evigrid/evigrid.hpp"
#include "evigrid/scenes/plan.hpp"
#include "export/octomap_slab.hpp"
#include "mapped_drive.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

Map loaded(const std::string& out) { return load(out + "/map.evigrid"); }

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> out;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) {
    out.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) out.back().push_back(field);
  }
  return out;
}

/// Bits of a float32 .npy of two dimensions, and its shape; by the format's description, not by our writer.
std::vector<float> read_npy(const std::string& bytes, std::int64_t& height, std::int64_t& width) {
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t head = static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + head) % 64, 0U);
  const std::string dict = bytes.substr(10, head);
  EXPECT_NE(dict.find("'descr': '<f4', 'fortran_order': False"), std::string::npos) << dict;
  EXPECT_EQ(std::sscanf(dict.c_str() + dict.find("'shape': (") + 10, "%ld, %ld", &height, &width), 2);
  std::vector<float> out((bytes.size() - 10 - head) / sizeof(float));
  std::memcpy(out.data(), bytes.data() + 10 + head, out.size() * sizeof(float));
  return out;
}

TEST(Export, CsvHoldsEverySeenCellToTheBit) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  const Map map = loaded(out);
  const Ran ran = evigrid({"export", out, "-o", "-"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto rows = rows_of(ran.out);
  ASSERT_EQ(rows.front(), (std::vector<std::string>{"ix", "iy", "e", "o", "u", "betp", "conflict"}));
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<float>> cells;  // by y, then x
  std::pair<std::int64_t, std::int64_t> last{INT64_MIN, 0};
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::pair<std::int64_t, std::int64_t> at{std::stoll(rows[i][1]), std::stoll(rows[i][0])};
    ASSERT_LT(last, at) << "row by row, smallest y first";
    last = at;
    for (std::size_t k = 2; k < rows[i].size(); ++k) cells[at].push_back(std::strtof(rows[i][k].c_str(), nullptr));
  }
  const CellRect b = map.bounds();
  std::size_t seen = 0;
  for (std::int64_t y = b.y; y < b.y + b.height; ++y) {
    for (std::int64_t x = b.x; x < b.x + b.width; ++x) {
      const Mass m = map.mass({x, y});
      if (m == Mass{}) {
        ASSERT_EQ(cells.count({y, x}), 0U);
        continue;
      }
      ++seen;
      ASSERT_EQ(cells.at({y, x}), (std::vector<float>{m.e, m.o, m.u, static_cast<float>(value_of(Layer::betp, m)),
                                                      map.conflict({x, y})}));
    }
  }
  EXPECT_EQ(cells.size(), seen);
  EXPECT_GT(seen, 1000U);

  const std::string file = dir.at("new/folder/cells.csv");
  ASSERT_EQ(evigrid({"export", out, "-o", file, "--metres", "--planes", "u,dsmp"}).code, 0);
  const auto metres = rows_of(slurp(file));
  ASSERT_EQ(metres.front(), (std::vector<std::string>{"x_m", "y_m", "u", "dsmp"}));
  ASSERT_EQ(metres.size(), rows.size());
  EXPECT_NEAR(std::stod(metres[1][0]), (std::stod(rows[1][0]) + 0.5) * 0.1, 1e-12);
  EXPECT_EQ(metres[1][2], rows[1][4]);
}

TEST(Export, CsvOfAMapOfManyTilesAndOfAPart) {
  const TempDir dir;
  Map map({.cell_m = 0.1, .rule = Rule::conjunctive});
  const std::vector<Mass> one{{0.25F, 0.5F, 0.125F, 0.125F}};
  for (const CellIndex at : {CellIndex{-1, -1}, CellIndex{0, 0}, CellIndex{500000000, 3}, CellIndex{-64, 63}})
    map.write({at.x, at.y, 1, 1}, one, 1);
  save(map, dir.at("m.evigrid"));
  const auto rows = rows_of(evigrid({"export", dir.at("m.evigrid"), "-o", "-", "--planes", "c,o"}).out);
  EXPECT_EQ(rows, (std::vector<std::vector<std::string>>{{"ix", "iy", "c", "o"},
                                                         {"-1", "-1", "0.125", "0.5"},
                                                         {"0", "0", "0.125", "0.5"},
                                                         {"500000000", "3", "0.125", "0.5"},
                                                         {"-64", "63", "0.125", "0.5"}}));
  const auto part =
      rows_of(evigrid({"export", dir.at("m.evigrid"), "-o", "-", "--planes", "c", "--region", "-0.1,-0.1,0,0.1"}).out);
  EXPECT_EQ(part, (std::vector<std::vector<std::string>>{{"ix", "iy", "c"}, {"-1", "-1", "0.125"}}));
  const Ran dense = evigrid({"export", dir.at("m.evigrid"), "-o", dir.at("arrays"), "--format", "npy"});
  EXPECT_EQ(dense.code, 2);  // 500 million cells wide
  EXPECT_TRUE(contains(dense.err, "--region exports a part")) << dense.err;
  EXPECT_FALSE(std::filesystem::exists(dir.at("arrays")));
}

TEST(Export, NpyPlanesAndWhereTheyLie) {
  const TempDir dir;
  const std::string out = mapped_drive(dir, {"--layers", "con"});
  const Map map = loaded(out);
  ASSERT_EQ(evigrid({"export", out, "-o", dir.at("arrays"), "--format", "npy", "--frame", "house"}).code, 0);
  const Json grid = Json::parse(slurp(dir.at("arrays/grid.json")));
  const CellRect b = map.bounds();
  EXPECT_EQ(grid["origin_cells"], Json({b.x, b.y}));
  EXPECT_EQ(grid["size_cells"], Json({b.width, b.height}));
  EXPECT_NEAR(grid["origin_m"][0].get<double>(), static_cast<double>(b.x) * 0.1, 1e-12);
  EXPECT_EQ(grid["cell_m"], 0.1);
  EXPECT_EQ(grid["frame"], "house");
  EXPECT_EQ(grid["map_hash"], Json::parse(slurp(out + "/report.json"))["map_hash"]);
  ASSERT_EQ(grid["planes"].size(), 6U);  // e o u betp conflict con
  for (const auto& [name, plane] : grid["planes"].items()) {
    std::int64_t height = 0, width = 0;
    const std::vector<float> cells =
        read_npy(slurp(dir.at("arrays/" + plane["file"].get<std::string>())), height, width);
    ASSERT_EQ(height, b.height);
    ASSERT_EQ(width, b.width);
    std::vector<float> wanted(cells.size());
    map.render(*layer_from_name(plane["layer"].get<std::string>()), b, wanted, b.width);
    EXPECT_EQ(cells, wanted) << name;
  }
}

TEST(Export, ARegionIsThatRectangleOfTheWhole) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  ASSERT_EQ(evigrid({"export", out, "-o", dir.at("all"), "--format", "npy", "--planes", "o"}).code, 0);
  ASSERT_EQ(evigrid({"export", out, "-o", dir.at("part"), "--format", "npy", "--planes", "o", "--region",
                     "-0.5,0.5,2.35,6.9"})
                .code,
            0);
  const Json grid = Json::parse(slurp(dir.at("part/grid.json")));
  EXPECT_EQ(grid["origin_cells"], Json({-5, 5}));
  EXPECT_EQ(grid["size_cells"], Json({29, 64}));
  std::int64_t height = 0, width = 0;
  const std::vector<float> cells = read_npy(slurp(dir.at("part/o.npy")), height, width);
  std::vector<float> wanted(cells.size());
  loaded(out).render(Layer::bel, {-5, 5, 29, 64}, wanted, 29);
  EXPECT_EQ(cells, wanted);

  const Json info = Json::parse(evigrid({"info", out, "--region", "0,2,1,3", "--json", "-"}).out);
  const Json whole = Json::parse(evigrid({"info", out, "--json", "-"}).out);
  EXPECT_EQ(info["map_hash"], whole["map_hash"]);
  EXPECT_EQ(info["region"]["cells"], Json({0, 20, 10, 10}));
  EXPECT_LT(info["region"]["bytes_read"], whole["file_bytes"]);
  EXPECT_EQ(info["region"]["hash"],
            fmt::format("{:016x}", load(out + "/map.evigrid", {.region = CellRect{0, 20, 10, 10}}).hash()));
  EXPECT_EQ(evigrid({"export", out, "-o", "-", "--region", "500,500,501,501"}).code, 2);
}

TEST(Export, MapServerInItsThreeModes) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  const Map map = loaded(out);
  const CellRect b = map.bounds();
  for (const std::string mode : {"trinary", "scale", "raw"}) {
    const std::string yaml = dir.at(mode + ".yaml");
    const Ran ran = evigrid({"export", out, "-o", yaml, "--mode", mode, "--occupied", "0.8", "--free", "0.3"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const scenes::FloorPlan plan = scenes::load_plan(yaml);
    ASSERT_EQ(plan.width, b.width);
    ASSERT_EQ(plan.height, b.height);
    EXPECT_NEAR(plan.origin.x_m, static_cast<double>(b.x) * 0.1, 1e-9);
    EXPECT_NEAR(plan.origin.y_m, static_cast<double>(b.y) * 0.1, 1e-9);
    int kinds[3]{};
    for (std::int64_t y = 0; y < b.height; ++y) {
      for (std::int64_t x = 0; x < b.width; ++x) {
        const Mass m = map.mass({b.x + x, b.y + y});
        const double p = value_of(Layer::betp, m);
        const int got = plan.occupancy[static_cast<std::size_t>(y * b.width + x)];
        if (mode == "raw") {
          EXPECT_EQ(got, m.u == 1 ? -1 : static_cast<int>(std::lround(100 * p)));
        } else if (p > 0.8 + 0.002 || p < 0.3 - 0.002) {  // a grey has 255 steps
          EXPECT_EQ(got, p > 0.8 ? 100 : 0) << p;
        } else if (mode == "trinary" && p > 0.302 && p < 0.798) {
          EXPECT_EQ(got, -1) << p;
        } else if (mode == "scale" && p > 0.302 && p < 0.798) {
          EXPECT_NEAR(got, 1 + 98 * (p - 0.3) / 0.5, 1.5);
        }
        ++kinds[got < 0 ? 0 : got < 50 ? 1 : 2];
      }
    }
    EXPECT_GT(kinds[1], 100);
    EXPECT_GT(kinds[2], 20);
  }
}

TEST(Export, AFormatThatIsNotBuiltNamesItsPackage) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  const auto refused = [&](std::vector<std::string> args, const std::string& package) {
    const auto before = dir.names();
    const Ran ran = evigrid(args);
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(contains(ran.err, package)) << ran.err;
    EXPECT_EQ(dir.names(), before);
  };
  const std::string bag = dir.write("a.bag", "#ROSBAG V2.0\n");
  if (!octomap_is_built()) refused({"export", out, "-o", dir.at("x.bt")}, "liboctomap-dev");
  if (!bags_are_built()) {
    refused({"export", out, "-o", dir.at("x.bag")}, "librosbag-storage-dev");
    refused({"map", bag, "-o", dir.at("x")}, "librosbag-storage-dev");
    refused({"log", bag}, "librosbag-storage-dev");
  }
  if (octomap_is_built() && bags_are_built()) GTEST_SKIP() << "OctoMap and ROS bags are built";
}

TEST(Export, BadInputIsNamedAndLeavesNothing) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  const auto refused = [&](std::vector<std::string> args, const std::string& why) {
    const auto before = dir.names();
    const Ran ran = evigrid(args);
    EXPECT_EQ(ran.code, 2) << why;
    EXPECT_TRUE(contains(ran.err, why)) << ran.err;
    EXPECT_EQ(dir.names(), before);
  };
  refused({"export", out, "-o", dir.at("x.tiff")}, "says no format");
  refused({"export", out, "-o", dir.at("x"), "--format", "tiff"}, "--format: 'tiff'");
  refused({"export", out, "-o", dir.at("x.csv"), "--planes", "e,q"}, "--planes: 'q' is unknown");
  refused({"export", out, "-o", dir.at("x.csv"), "--planes", "e,e"}, "given twice");
  refused({"export", out, "-o", dir.at("x.csv"), "--planes", "con"}, "keeps no con");
  refused({"export", out, "-o", dir.at("x.yaml"), "--free", "0.7"}, "--free, --occupied");
  refused({"export", out, "-o", dir.at("x.yaml"), "--mode", "binary"}, "--mode: 'binary'");
  refused({"export", out, "-o", dir.at("out") + "/map.png/x.csv"}, "cannot be written");
  refused({"export", dir.at("none"), "-o", dir.at("x.csv")}, "none");
  refused({"export", dir.write("junk.evigrid", "junk"), "-o", dir.at("x.csv")}, "is not an evigrid map");
  refused({"export", out, "-o", dir.at("x.csv"), "--region", "1,1,0,0"}, "--region");
}

TEST(Export, OptionsOfOtherFormatsAreRefused) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  const std::string csv = dir.at("x.csv"), yaml = dir.at("x.yaml");
  const auto before = dir.names();
  struct Row {
    std::vector<std::string> arguments;
    std::string message;
  };
  for (const Row& row : {Row{{"-o", csv, "--mode", "trinary"}, "--mode: is for map_server"},  // the default, but given
                         Row{{"-o", csv, "--occupied", "0.7"}, "--occupied: is for map_server, octomap and bag"},
                         Row{{"-o", csv, "--free", "0.1"}, "--free: is for map_server, octomap and bag"},
                         Row{{"-o", csv, "--max-unknown", "0.5"}, "--max-unknown: is for bag"},
                         Row{{"-o", csv, "--slab", "0,1"}, "--slab: is for octomap"},
                         Row{{"-o", "-", "--frame", "f"}, "--frame: is for npy and bag"},
                         Row{{"-o", csv, "--topic", "/t"}, "--topic: is for bag"},
                         Row{{"-o", csv, "--max-image-mb", "9"}, "--max-image-mb: is for npy, map_server, octomap"},
                         Row{{"-o", yaml, "--planes", "e"}, "--planes: is for csv and npy"},
                         Row{{"-o", yaml, "--metres"}, "--metres: is for csv"},
                         Row{{"-o", yaml, "--slab", "0,1"}, "--slab: is for octomap"},
                         Row{{"-o", dir.at("x"), "--format", "npy", "--mode", "raw"}, "--mode: is for map_server"}}) {
    for (const char* command : {"export", "convert"}) {
      std::vector<std::string> arguments{command, out};
      arguments.insert(arguments.end(), row.arguments.begin(), row.arguments.end());
      const Ran ran = evigrid(arguments);
      EXPECT_EQ(ran.code, 2) << row.message;
      EXPECT_TRUE(contains(ran.err, row.message)) << ran.err;
      EXPECT_EQ(ran.out, "");
      EXPECT_EQ(dir.names(), before);
    }
  }
}

TEST(Export, WhatWasNeverSeenIsUnknownWhateverTheThresholds) {
  const TempDir dir;
  const std::string out = mapped_drive(dir);
  const Map map = loaded(out);
  const CellRect b = map.bounds();
  for (const auto& [free, occupied] : {std::pair{"0.6", "0.7"}, {"0.1", "0.4"}}) {
    const Ran ran = evigrid({"export", out, "-o", dir.at("t.yaml"), "--free", free, "--occupied", occupied});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string pgm = slurp(dir.at("t.pgm"));
    const std::size_t first = pgm.size() - static_cast<std::size_t>(b.width * b.height);
    int unknown = 0;
    for (std::int64_t y = 0; y < b.height; ++y) {
      for (std::int64_t x = 0; x < b.width; ++x) {
        if (map.mass({b.x + x, b.y + y}) != Mass{}) continue;
        ++unknown;
        ASSERT_EQ(static_cast<unsigned char>(pgm[first + static_cast<std::size_t>((b.height - 1 - y) * b.width + x)]),
                  205);
      }
    }
    EXPECT_GT(unknown, 100);
  }
}

}  // namespace
}  // namespace evigrid::driver
