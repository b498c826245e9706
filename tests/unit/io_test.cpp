// SPDX-License-Identifier: Apache-2.0
// A saved map is the same map, a damaged one is an error.
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "equivalence/random_scans.hpp"
#include "evigrid/io.hpp"
#include "evigrid/merge.hpp"
#include "temp_folder.hpp"
#include "unit/golden_map.hpp"

namespace evigrid {
namespace {

// A field added to these structures is to be saved too: engine/src/io/header.cpp lists them.
static_assert(sizeof(Sensor) == 376 && sizeof(MapParams) == 64, "list the new field in engine/src/io/header.cpp");

std::string bytes_of(const Map& map) {
  std::ostringstream out;
  save(map, out);
  return out.str();
}
std::span<const std::byte> view(const std::string& s) { return std::as_bytes(std::span(s)); }

Map driven(const testing::Drive& d, MapParams params, std::size_t scans) {
  Map map(params, make_serial_executor());
  for (const Sensor& s : d.sensors) map.add(s);
  map.integrate(std::span(d.scans).first(scans));
  return map;
}

/// One cone in a few tiles.
Map tiny(bool conflict = true) {
  Map map({.cell_m = 0.1, .rule = Rule::dempster, .keep_conflict = conflict}, make_serial_executor());
  Sensor s;
  s.reliability = 0.9;
  const SensorId id = map.add(s);
  for (const float range_m : {2.0f, 1.5f}) {
    const Reading reading{id, {&range_m, 1}};
    map.integrate(Scan{7, {-1, -1, 0.5}, {&reading, 1}});
  }
  return map;
}

void expect_same_bits(const Map& a, const Map& b) {
  EXPECT_EQ(a.hash(), b.hash());
  ASSERT_EQ(a.bounds(), b.bounds());
  const CellRect r = a.bounds();
  for (std::int64_t y = r.y; y < r.y + r.height; ++y) {
    for (std::int64_t x = r.x; x < r.x + r.width; ++x) {
      const Mass m = a.mass({x, y}), n = b.mass({x, y});
      ASSERT_EQ(std::bit_cast<std::uint32_t>(m.e), std::bit_cast<std::uint32_t>(n.e));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(m.o), std::bit_cast<std::uint32_t>(n.o));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(m.u), std::bit_cast<std::uint32_t>(n.u));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(a.conflict({x, y})), std::bit_cast<std::uint32_t>(b.conflict({x, y})));
    }
  }
}

std::string message_of(const std::string& bytes, const LoadOptions& options = {}) {
  try {
    (void)load(view(bytes), options, "some.evigrid");
  } catch (const MapFileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SavedMap, GoesOnFusingAsIfItHadNeverBeenSaved) {
  const auto d = testing::drive(Model::li2014, 40, 5);
  for (const Rule rule : map_rules()) {
    for (const bool keep : {true, false}) {
      const MapParams params{.cell_m = 0.05, .rule = rule, .keep_conflict = keep};
      const Map whole = driven(*d, params, 40);
      const Map half = driven(*d, params, 20);
      Map loaded = load(view(bytes_of(half)), {.executor = make_tbb_executor(2)});
      expect_same_bits(half, loaded);
      Report report = loaded.integrate(std::span(d->scans).subspan(20));
      EXPECT_EQ(report.stamps_backwards, 0u);
      expect_same_bits(whole, loaded);
      EXPECT_EQ(whole.tiles(), loaded.tiles()) << name(rule);
    }
  }
}

TEST(SavedMap, TheLastStampIsKept) {
  Map loaded = load(view(bytes_of(tiny())));
  EXPECT_EQ(loaded.integrate(Scan{6, {}, {}}).stamps_backwards, 1u);
  Map fresh = load(view(bytes_of(Map())));
  EXPECT_EQ(fresh.integrate(Scan{std::numeric_limits<std::int64_t>::min() + 1, {}, {}}).stamps_backwards, 0u);
}

TEST(SavedMap, EveryParameterComesBack) {
  Map map({.cell_m = 0.1 + 1e-17 + 1.0 / 3,
           .rule = Rule::pcr2,
           .kernel = Kernel::scalar,
           .keep_con = true,
           .keep_last_conflict = true,
           .bayes = {Likelihood::plp, 0.01, 0.98},
           .memory_cap_bytes = 1 << 25});
  Sensor s;  // no field has its default
  s.model = Model::beam;
  s.T_robot_sensor = {0.1, -0.2, 1.0 / 3};
  s.aperture_rad = 0.3;
  s.min_range_m = 0.25;
  s.max_range_m = 7.7;
  s.no_return_m = 81.9;
  s.clear_no_return = true;
  s.reliability = 0.85;
  s.reliability_if_empty = 0.7, s.reliability_if_occupied = 0.6;
  s.beams = 180;
  s.first_beam_rad = -1.5;
  s.beam_step_rad = 0.0174;
  s.hughes = {6.5, 0.9, 0.2};
  s.li = {0.4, 0.2, 100, 5, 0.005};
  s.beam = {0.55, 0.75, 0.2, 0.12};
  map.add(Sensor{});
  map.add(s);
  const std::string bytes = bytes_of(map);
  const Map loaded = load(view(bytes));
  EXPECT_EQ(loaded.params().cell_m, map.params().cell_m);
  EXPECT_EQ(loaded.params().rule, Rule::pcr2);
  EXPECT_TRUE(loaded.params().keep_con && loaded.params().keep_last_conflict);
  EXPECT_EQ(loaded.params().bayes.likelihood, Likelihood::plp);
  EXPECT_EQ(loaded.params().bayes.least_p, 0.01);
  EXPECT_EQ(loaded.params().bayes.most_p, 0.98);
  EXPECT_EQ(loaded.sensors()[1].reliability_if_empty, 0.7);
  EXPECT_EQ(loaded.sensors()[1].reliability_if_occupied, 0.6);
  EXPECT_EQ(loaded.params().kernel, Kernel::scalar);
  EXPECT_EQ(loaded.kernel_name(), "scalar");
  EXPECT_EQ(loaded.params().keep_conflict, true);
  EXPECT_EQ(loaded.params().memory_cap_bytes, std::size_t{1} << 25);
  ASSERT_EQ(loaded.sensors().size(), 2u);
  const Sensor& t = loaded.sensors()[1];
  const auto numbers = [](const Sensor& q) {
    return std::vector<double>{static_cast<double>(q.model),
                               q.T_robot_sensor.x_m,
                               q.T_robot_sensor.y_m,
                               q.T_robot_sensor.yaw_rad,
                               q.aperture_rad,
                               q.min_range_m,
                               q.max_range_m,
                               q.no_return_m,
                               static_cast<double>(q.clear_no_return),
                               q.reliability,
                               static_cast<double>(q.beams),
                               q.first_beam_rad,
                               q.beam_step_rad,
                               q.hughes.r_max_m,
                               q.hughes.max_occupied,
                               q.hughes.tolerance_m,
                               q.li.rho_e,
                               q.li.rho_o,
                               q.li.rho_c,
                               q.li.rho_i,
                               q.li.epsilon_ratio,
                               q.beam.empty,
                               q.beam.occupied,
                               q.beam.empty_margin_m,
                               q.beam.occupied_half_width_m};
  };
  EXPECT_EQ(numbers(t), numbers(s));
  EXPECT_EQ(numbers(loaded.sensors()[0]), numbers(Sensor{}));
  const MapFileInfo info = inspect(view(bytes));
  EXPECT_EQ(info.sensors.size(), 2u);
  EXPECT_EQ(info.tiles, 0u);
  EXPECT_EQ(info.hash, map.hash());
  EXPECT_EQ(info.maths_version, kMathsVersion);
  EXPECT_EQ(info.file_bytes, bytes.size());
}

TEST(SavedMap, SameBytesFromAnyExecutorAndAgainAfterLoading) {
  const auto d = testing::drive(Model::hughes1992, 30, 2);
  std::vector<std::string> files;
  for (const int threads : {1, 3}) {
    Map map({.cell_m = 0.05}, make_tbb_executor(threads));
    for (const Sensor& s : d->sensors) map.add(s);
    map.integrate(d->scans);
    files.push_back(bytes_of(map));
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(bytes_of(load(view(files[0]))), files[0]);
}

TEST(SavedMap, FilesAreWholeOrAbsent) {
  const std::filesystem::path dir =
      std::filesystem::temp_directory_path() / ("evigrid-io-" + std::to_string(std::random_device{}()));
  std::filesystem::create_directory(dir);
  const Map map = tiny();
  save(map, dir / "a.evigrid");
  save(map, dir / "a.evigrid");  // over itself
  expect_same_bits(map, load(dir / "a.evigrid"));
  EXPECT_EQ(inspect(dir / "a.evigrid").tiles, map.tiles());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir), std::filesystem::directory_iterator{}), 1);
  EXPECT_THROW(save(map, dir / "no/a.evigrid"), MapFileError);
  EXPECT_THROW((void)load(dir), MapFileError);
  EXPECT_THROW((void)load(dir / "absent"), MapFileError);
  std::filesystem::resize_file(dir / "a.evigrid", 200);
  EXPECT_THROW((void)load(dir / "a.evigrid"), MapFileError);
  std::filesystem::remove_all(dir);
}

TEST(DamagedMap, EveryTruncationIsAnError) {
  const std::string whole = bytes_of(tiny());
  for (std::size_t n = 0; n < whole.size(); ++n) ASSERT_NE(message_of(whole.substr(0, n)), "no error") << n;
  EXPECT_NE(message_of(whole + '\0'), "no error");
  EXPECT_EQ(message_of(whole), "no error");
}

TEST(DamagedMap, EveryFlippedBitIsAnError) {
  const std::string whole = bytes_of(tiny());
  std::mt19937 rng(3);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ (1 << rng() % 8));
    ASSERT_NE(message_of(bad), "no error") << at;
    bad[at] = static_cast<char>(rng());
    bad[rng() % bad.size()] = static_cast<char>(rng());
    if (bad != whole) {
      ASSERT_NE(message_of(bad), "no error") << at;
    }
  }
}

TEST(DamagedMap, MessagesNameTheFileAndTheDamage) {
  const std::string whole = bytes_of(tiny());
  const auto has = [](const std::string& text, const char* part) {
    return text.starts_with("some.evigrid: ") && text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(message_of(""), "is empty"));
  EXPECT_TRUE(has(message_of("P5\n3 3\n255\n123456789"), "is not an evigrid map"));
  EXPECT_TRUE(has(message_of(whole.substr(0, whole.size() - 1)), "truncated"));
  EXPECT_TRUE(has(message_of(whole.substr(0, whole.size() / 2)), "truncated"));
  std::string bad = whole;
  bad[whole.find("cell_m")] ^= 1;
  EXPECT_TRUE(has(message_of(bad), "checksum of the header"));
  bad = whole;
  bad[whole.find("\x28\xB5\x2F\xFD") + 20] ^= 1;  // inside the first zstd frame
  EXPECT_TRUE(has(message_of(bad), "tile 0 has a wrong checksum"));
  EXPECT_TRUE(has(message_of(whole, {.memory_cap_bytes = 1000}), "memory cap of 1000"));
}

TEST(SavedMap, TheSavedKernelIsAWishAndTheCapOfTheHostRules) {
  const std::string bytes = bytes_of(tiny());
  const Map map = load(view(bytes), {.kernel = Kernel::scalar, .memory_cap_bytes = std::size_t{1} << 20});
  EXPECT_EQ(map.kernel_name(), "scalar");
  EXPECT_EQ(map.params().memory_cap_bytes, std::size_t{1} << 20);
}

TEST(SavedMap, AFileOfVersionOneStaysReadable) {
  std::string bytes;
  for (std::size_t i = 0; kGoldenMapV1[i] != '\0'; i += 2)
    bytes += static_cast<char>(std::stoi(std::string(kGoldenMapV1 + i, 2), nullptr, 16));
  Map map = load(view(bytes));
  EXPECT_EQ(map.params().rule, Rule::pcr2);
  EXPECT_EQ(map.params().cell_m, 0.25);
  ASSERT_EQ(map.sensors().size(), 1u);
  EXPECT_EQ(map.sensors()[0].aperture_rad, 0.4);
  EXPECT_EQ(map.sensors()[0].reliability, 0.9);
  EXPECT_EQ(map.bounds(), (CellRect{6, 3, 4, 2}));
  EXPECT_EQ(map.mass({6, 3}), (Mass{0x1.fadf04p-1f, 0x1.2217bcp-16f, 0x1.47ae16p-7f}));
  EXPECT_EQ(map.mass({7, 3}), (Mass{0x1.2d3bdp-1f, 0x1.9b4af4p-2f, 0x1.47ae14p-7f}));
  EXPECT_EQ(map.mass({9, 4}), (Mass{0x1.10a8bep-5f, 0x1.bbc23ep-1f, 0x1.999998p-4f}));
  EXPECT_EQ(map.conflict({7, 3}), 0x1.717a8ep-1f);
  EXPECT_EQ(map.mass({10, 3}), Mass{});
  const float range_m = 1;
  const Reading reading{0, {&range_m, 1}};
  EXPECT_EQ(map.integrate(Scan{41, {}, {&reading, 1}}).stamps_backwards, 1u);  // its last stamp was 42
}

TEST(SavedMap, WindowAndProtectedAreasGoOn) {
  const auto d = testing::drive(Model::li2014, 24, 3);
  Map map = driven(*d, {}, 12);
  map.set_window({-64, -64, 128, 192});
  map.protect({3, -5, 40, 20});
  map.protect({-30, 10, 7, 9});
  const std::string of_map = bytes_of(map);
  std::ostringstream of_view;
  save(map.view(), of_view);
  EXPECT_EQ(of_view.str(), of_map);
  Map loaded = load(view(of_map));
  EXPECT_EQ(bytes_of(loaded), of_map);
  ASSERT_EQ(loaded.protected_areas().size(), 2u);
  EXPECT_EQ(loaded.protected_areas()[0], (CellRect{3, -5, 40, 20}));
  EXPECT_EQ(inspect(view(of_map)).window, (CellRect{-64, -64, 128, 192}));
  Map free = driven(*d, {}, 12);
  for (Map* const m : {&map, &loaded, &free}) m->integrate(std::span(d->scans).subspan(12));
  expect_same_bits(loaded, map);
  EXPECT_NE(map.hash(), free.hash());  // they kept something off
}

TEST(SavedMap, TheWidestWindowIsReadAgain) {
  Map map = tiny();
  const std::int64_t far = std::int64_t{1} << 60;
  map.set_window({1 - far, 1 - far, 2 * far, 2 * far});
  EXPECT_EQ(load(view(bytes_of(map))).hash(), map.hash());
}

TEST(SavedMap, ThreadsThatSaveToOnePathLeaveAWholeMap) {
  const TempFolder folder;
  const auto path = folder.path() / "map.evigrid";
  const auto d = testing::drive(Model::li2014, 12, 3);
  const Map map = driven(*d, {}, 12);
  std::vector<std::thread> savers;
  for (int i = 0; i < 4; ++i)
    savers.emplace_back([&] {
      for (int k = 0; k < 10; ++k) save(map, path);
    });
  for (int k = 0; k < 20; ++k) {
    if (std::filesystem::exists(path)) {
      EXPECT_EQ(load(path).hash(), map.hash());
    }
  }
  for (std::thread& t : savers) t.join();
  EXPECT_EQ(load(path).hash(), map.hash());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(SavedMap, AStreamThatFailsAtItsEndIsAnError) {
  struct Full final : std::stringbuf {
    int sync() override { return -1; }
  } full;
  std::ostream out(&full);
  EXPECT_THROW(save(tiny(), out), MapFileError);
}

TEST(SavedMap, ConflictOfMembershipsMayBeMoreThanOne) {
  const MapParams params{.rule = Rule::fuzzy, .keep_last_conflict = true};
  Map a(params, make_serial_executor()), b(params, make_serial_executor());
  const std::vector<Mass> both{{0.9f, 0.8f, 0, 0}};
  a.write({0, 0, 1, 1}, both, 1), b.write({0, 0, 1, 1}, both, 1);
  merge(a, b.view());
  ASSERT_GT(a.last_conflict({0, 0}), 1.1f);
  EXPECT_EQ(load(view(bytes_of(a))).last_conflict({0, 0}), a.last_conflict({0, 0}));
}

}  // namespace
}  // namespace evigrid
