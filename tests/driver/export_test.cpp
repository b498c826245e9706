// SPDX-License-Identifier: Apache-2.0
// evigrid export, convert and --region: every format read back by other means than the writer's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "evigrid/evigrid.hpp"
#include "evigrid/scenes/plan.hpp"
#include "program.hpp"
#include "records.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::json;

/// The map of a short drive, and its folder.
std::string mapped(const TempDir& dir, std::vector<std::string> more = {}) {
  std::string log;
  for (int i = 0; i < 5; ++i) log += flaser(180, fmt::format("{}", 3 + 0.2 * i), i, fmt::format("{} 2 0.5", 0.4 * i));
  std::vector<std::string> all{"map", dir.write("a.log", log), "-o", dir.at("out"), "--cell", "0.1"};
  all.insert(all.end(), more.begin(), more.end());
  const Ran ran = evigrid(all);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return dir.at("out");
}
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
  const std::string out = mapped(dir);
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
  const std::string out = mapped(dir, {"--layers", "con"});
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
  const std::string out = mapped(dir);
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

/// By a reader of the format: nav_msgs values of each cell.
scenes::FloorPlan reread(const std::string& yaml) { return scenes::load_plan(yaml); }

TEST(Export, MapServerInItsThreeModes) {
  const TempDir dir;
  const std::string out = mapped(dir);
  const Map map = loaded(out);
  const CellRect b = map.bounds();
  for (const std::string mode : {"trinary", "scale", "raw"}) {
    const std::string yaml = dir.at(mode + ".yaml");
    const Ran ran = evigrid({"export", out, "-o", yaml, "--mode", mode, "--occupied", "0.8", "--free", "0.3"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const scenes::FloorPlan plan = reread(yaml);
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

TEST(Convert, AMapServerMapBecomesAMapAndComesBack) {
  const TempDir dir;
  const std::string out = mapped(dir);
  for (const std::string mode : {"trinary", "raw"}) {
    const std::string yaml = dir.at("a.yaml"), back = dir.at("b.yaml"), ours = dir.at("m.evigrid");
    ASSERT_EQ(evigrid({"export", out, "-o", yaml, "--mode", mode}).code, 0);
    const Ran ran = evigrid({"convert", yaml, "-o", ours, "--certainty", "1", "--rule", "dempster"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");  // whole cells: no pixel was moved
    ASSERT_EQ(evigrid({"convert", ours, "-o", back, "--mode", mode}).code, 0);
    const scenes::FloorPlan a = reread(yaml), b = reread(back);
    const auto at = [](const scenes::FloorPlan& plan, std::int64_t ix, std::int64_t iy) {
      const std::int64_t x = ix - std::llround(plan.origin.x_m / 0.1), y = iy - std::llround(plan.origin.y_m / 0.1);
      if (x < 0 || y < 0 || x >= plan.width || y >= plan.height) return -1;
      return static_cast<int>(plan.occupancy[static_cast<std::size_t>(y * plan.width + x)]);
    };
    for (std::int64_t y = -100; y < 100; ++y) {
      for (std::int64_t x = -100; x < 100; ++x) ASSERT_EQ(at(a, x, y), at(b, x, y)) << x << ' ' << y << ' ' << mode;
    }
  }
  const Map map = load(dir.at("m.evigrid"));
  EXPECT_EQ(map.params().rule, Rule::dempster);
  EXPECT_EQ(map.params().cell_m, 0.1);
}

TEST(Convert, CertaintyIsWhatIsKnown) {
  const TempDir dir;
  dir.write("a.pgm", "P2 3 2 255\n0 254 205\n254 0 0\n");
  const std::string yaml = dir.write("a.yaml",
                                     "image: a.pgm\nresolution: 0.5\norigin: [-1.0, 2.5, 0]\nnegate: 0\n"
                                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  ASSERT_EQ(evigrid({"convert", yaml, "-o", dir.at("m.evigrid"), "--certainty", "0.75"}).code, 0);
  const Map map = load(dir.at("m.evigrid"));
  EXPECT_EQ(map.bounds(), (CellRect{-2, 5, 3, 2}));
  EXPECT_EQ(map.mass({-2, 5}), (Mass{0.75F, 0, 0.25F}));  // the lower row is the image's last
  EXPECT_EQ(map.mass({-1, 5}), (Mass{0, 0.75F, 0.25F}));
  EXPECT_EQ(map.mass({-2, 6}), (Mass{0, 0.75F, 0.25F}));
  EXPECT_EQ(map.mass({0, 6}), Mass{});
  // A part of a saved map as a saved map.
  ASSERT_EQ(evigrid({"convert", dir.at("m.evigrid"), "-o", dir.at("p.evigrid"), "--region", "-1,2.5,-0.5,3"}).code, 0);
  EXPECT_EQ(load(dir.at("p.evigrid")).bounds(), (CellRect{-2, 5, 1, 1}));
}

TEST(Convert, ATurnedPlanIsTakenUnderTheCentresOfCells) {
  const TempDir dir;
  dir.write(
      "a.pgm", "P2 40 20 255\n" + [] {
        std::string all;
        for (int i = 0; i < 800; ++i) all += i % 40 < 20 ? "0 " : "254 ";
        return all;
      }());
  const std::string yaml = dir.write("a.yaml",
                                     "image: a.pgm\nresolution: 0.1\norigin: [1.03, 2.0, 0.5235987755982988]\n"
                                     "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const Ran ran = evigrid({"convert", yaml, "-o", dir.at("m.evigrid"), "--certainty", "1"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(contains(ran.err, "under its centre")) << ran.err;
  const Map map = load(dir.at("m.evigrid"));
  const auto at = [&](double along, double across) {  // in the plan, m
    const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
    return map.mass(map.cell_at(1.03 + along * c - across * s, 2 + along * s + across * c));
  };
  EXPECT_EQ(at(0.5, 1).o, 1);
  EXPECT_EQ(at(1.8, 1.8).o, 1);
  EXPECT_EQ(at(2.2, 0.2).e, 1);
  EXPECT_EQ(at(3.8, 1).e, 1);
  EXPECT_EQ(at(-0.2, 1), Mass{});
  EXPECT_EQ(at(2, 2.2), Mass{});
  std::int64_t known = 0;
  const CellRect b = map.bounds();
  for (std::int64_t y = b.y; y < b.y + b.height; ++y)
    for (std::int64_t x = b.x; x < b.x + b.width; ++x) known += map.mass({x, y}) != Mass{};
  EXPECT_NEAR(static_cast<double>(known), 800, 20);
}

TEST(Export, BadInputIsNamedAndLeavesNothing) {
  const TempDir dir;
  const std::string out = mapped(dir);
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
  refused({"export", out, "-o", dir.at("x.yaml"), "--planes", "e"}, "--planes: is for csv and npy");
  refused({"export", out, "-o", dir.at("x.yaml"), "--free", "0.7"}, "--free, --occupied");
  refused({"export", out, "-o", dir.at("x.yaml"), "--mode", "binary"}, "--mode: 'binary'");
  refused({"export", out, "-o", dir.at("out") + "/map.png/x.csv"}, "cannot be written");
  refused({"export", dir.at("none"), "-o", dir.at("x.csv")}, "none");
  refused({"export", dir.write("junk.evigrid", "junk"), "-o", dir.at("x.csv")}, "is not an evigrid map");
  refused({"export", out, "-o", dir.at("x.csv"), "--region", "1,1,0,0"}, "--region");
  refused({"convert", dir.at("none.yaml"), "-o", dir.at("x.evigrid")}, "none.yaml");
  refused({"convert", dir.write("a.pgm", "P2 1 1 255 0\n"), "-o", dir.at("x.evigrid")}, "resolution_m: is missing");
  refused({"convert", dir.at("a.pgm"), "--resolution", "1", "-o", dir.at("x.evigrid"), "--certainty", "1.5"},
          "--certainty");
  refused({"convert", dir.at("a.pgm"), "--resolution", "1", "-o", dir.at("x.evigrid"), "--region", "0,0,1,1"},
          "--region: is for saved maps");
}

}  // namespace
}  // namespace evigrid::driver
