// SPDX-License-Identifier: Apache-2.0
// Maps larger than their cap, their cold tiles in a page file: beside each a map with room for everything, which must
// stay the same to the bit whatever is done to both.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>
#include <thread>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "temp_folder.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kCap = std::size_t{40} << 16;  // forty tiles of four planes

struct Pair {
  Map roomy, paged;
  Pair(const testing::Drive& d, MapParams params, const std::string& executor, const std::filesystem::path& dir)
      : roomy(params, make_serial_executor()), paged(capped(params), make_executor(executor, 2)) {
    paged.page_to(dir);
    for (const Sensor& s : d.sensors) roomy.add(s), paged.add(s);
  }
  static MapParams capped(MapParams p) {
    p.memory_cap_bytes = kCap;
    return p;
  }
  template <class F>
  void both(F&& act) {
    act(roomy), act(paged);
    EXPECT_LE(paged.memory_bytes(), kCap);
  }
  void expect_same() {
    ASSERT_EQ(paged.hash(), roomy.hash());
    ASSERT_EQ(paged.tiles(), roomy.tiles());
    ASSERT_EQ(paged.version(), roomy.version());
  }
};

std::filesystem::path scratch() { return std::filesystem::temp_directory_path(); }

/// The drive's scans thrown over a square of 400 m, two in three near the one before.
class Places {
 public:
  explicit Places(unsigned seed) : random_(seed) {}
  Scan place(Scan s) {
    std::uniform_real_distribution<double> far(-200, 200), near(-5, 5);
    if (random_() % 3 == 0) x_ = far(random_), y_ = far(random_);
    s.T_map_robot = {x_ + near(random_), y_ + near(random_), s.T_map_robot.yaw_rad};
    s.stamp_ns = stamp_ += 50'000'000;
    return s;
  }
  CellRect rect() {
    const auto cell = [&](double m) { return static_cast<std::int64_t>(m / 0.05) + static_cast<int>(random_() % 90); };
    return {cell(x_) - 60, cell(y_) - 60, 1 + static_cast<int>(random_() % 150), 1 + static_cast<int>(random_() % 150)};
  }
  std::mt19937& random() { return random_; }

 private:
  std::mt19937 random_;
  double x_ = 0, y_ = 0;
  std::int64_t stamp_ = 0;
};

/// Everything that a map does, at random, a view now and then kept for a while.
void live(const MapParams& params, Model model, const std::string& executor, unsigned seed, int steps) {
  const auto d = testing::drive(model, 40, seed);
  Pair maps(*d, params, executor, scratch());
  Places places(seed);
  struct Kept {
    MapView view;
    std::uint64_t hash;
  };
  std::vector<Kept> kept;
  std::size_t most_paged = 0;
  for (int step = 0; step < steps; ++step) {
    const Scan scan = places.place(d->scans[static_cast<std::size_t>(step) % d->scans.size()]);
    maps.both([&](Map& m) { m.integrate(scan); });
    const CellRect r = places.rect();
    switch (places.random()() % 12) {
      case 0:
        maps.both([&](Map& m) { m.clear(r); });
        break;
      case 1:
        maps.both([&](Map& m) { m.protect(r); });
        break;
      case 2:
        maps.both([&](Map& m) { m.unprotect(); });
        break;
      case 3:
        maps.both([&](Map& m) {
          const std::vector<Mass> wall(static_cast<std::size_t>(r.width * r.height), Mass{0, 0.75f, 0.25f});
          m.write(r, wall, r.width);
        });
        break;
      case 4:
        kept.push_back({maps.paged.view(), maps.roomy.hash()});
        break;
      case 5:
        if (params.rule == Rule::dempster_log) maps.both([&](Map& m) { m.undo(scan); });
        break;
      default:
        break;
    }
    if (kept.size() > 2 || (!kept.empty() && places.random()() % 3 == 0)) {
      ASSERT_EQ(kept.front().view.hash(), kept.front().hash);
      kept.erase(kept.begin());
    }
    most_paged = std::max(most_paged, maps.paged.paged_bytes());
    if (step % 16 == 0) maps.expect_same();
  }
  maps.expect_same();
  EXPECT_GT(most_paged, 2 * kCap);
  EXPECT_EQ(maps.roomy.paged_bytes(), 0u);
  // A window drops most of it, clear() the rest: file and memory come back.
  maps.both([&](Map& m) { m.set_window({-1000, -1000, 2000, 2000}); });
  maps.expect_same();
  maps.both([&](Map& m) { m.clear(); });
  kept.clear();
  EXPECT_EQ(maps.paged.paged_bytes() + maps.paged.memory_bytes(), 0u);
}

TEST(Paging, ADriveOverTheCapGivesTheSameBits) {
  live({.rule = Rule::pcr5}, Model::li2014, "serial", 1, 150);
  live({.rule = Rule::dempster}, Model::hughes1992, "tbb", 2, 150);
}
TEST(Paging, SumsUndoneAndMapsThatForget) {
  live({.rule = Rule::dempster_log}, Model::hughes1992, "spin", 3, 120);
  live({.rule = Rule::pcr5, .keep_conflict = false, .decay_s = 3}, Model::li2014, "openmp", 4, 120);
}

TEST(Paging, MergingRewindingAndReposing) {
  const auto d = testing::drive(Model::li2014, 40, 5);
  Pair maps(*d, {.rule = Rule::pcr5}, "tbb", scratch());
  Places places(5);
  std::vector<Scan> scans;
  for (int i = 0; i < 120; ++i) scans.push_back(places.place(d->scans[static_cast<std::size_t>(i % 40)]));
  RevisableMap roomy(std::move(maps.roomy), {.checkpoint_every = 32}),
      paged(std::move(maps.paged), {.checkpoint_every = 32});
  for (const Scan& s : scans) {
    roomy.integrate(std::span(&s, 1)), paged.integrate(std::span(&s, 1));
    ASSERT_LE(paged.map().memory_bytes(), kCap);
  }
  EXPECT_GT(paged.map().paged_bytes(), kCap);
  ASSERT_EQ(paged.map().hash(), roomy.map().hash());
  for (const ScanId id : {100u, 50u, 7u}) {
    roomy.remove(id), paged.remove(id);
    ASSERT_EQ(paged.map().hash(), roomy.map().hash());
    roomy.move(id + 1, {3, 4, 1}), paged.move(id + 1, {3, 4, 1});
    ASSERT_EQ(paged.map().hash(), roomy.map().hash());
  }
  // Into a third map that pages, from one that does.
  Map into(Pair::capped({.rule = Rule::pcr5}), make_serial_executor()),
      free({.rule = Rule::pcr5}, make_serial_executor());
  into.page_to(scratch());
  for (const Sensor& s : d->sensors) into.add(s), free.add(s);
  for (const Scan& s : std::span(scans).first(30)) into.integrate(s), free.integrate(s);
  const auto few = testing::drive(Model::li2014, 8, 6);
  Map robot({.rule = Rule::pcr5}, make_serial_executor());
  for (const Sensor& s : few->sensors) robot.add(s);
  robot.integrate(few->scans);
  const MergeOptions how{.T_into_from = {scans[3].T_map_robot.x_m, scans[3].T_map_robot.y_m, 0.7}, .reliability = 0.9};
  merge(into, robot.view(), how), merge(free, robot.view(), how);
  EXPECT_EQ(into.hash(), free.hash());
}

TEST(Paging, ReadersOfAViewReadOnWhileItsTilesGoOut) {
  const auto d = testing::drive(Model::li2014, 40, 7);
  Pair maps(*d, {.rule = Rule::pcr5}, "tbb", scratch());
  Places places(7);
  for (int i = 0; i < 60; ++i) {
    const Scan s = places.place(d->scans[static_cast<std::size_t>(i % 40)]);
    maps.both([&](Map& m) { m.integrate(s); });
  }
  const std::uint64_t hash = maps.roomy.hash();
  std::atomic<bool> stop{false};
  std::atomic<int> reads{0}, wrong{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&, view = maps.paged.view()] {
      while (!stop) {
        if (view.hash() != hash) ++wrong;
        ++reads;
      }
    });
  }
  for (int i = 0; i < 300 || reads < 20; ++i) {
    const Scan s = places.place(d->scans[static_cast<std::size_t>(i % 40)]);
    maps.both([&](Map& m) { m.integrate(s); });
  }
  stop = true;
  for (std::thread& t : readers) t.join();
  EXPECT_EQ(wrong, 0);
  maps.expect_same();
}

TEST(Paging, SavedAndLoadedOverTheCap) {
  const auto d = testing::drive(Model::li2014, 40, 8);
  Pair maps(*d, {.rule = Rule::pcr5}, "tbb", scratch());
  Places places(8);
  for (int i = 0; i < 200; ++i) {
    const Scan s = places.place(d->scans[static_cast<std::size_t>(i % 40)]);
    maps.both([&](Map& m) { m.integrate(s); });
  }
  const TempFolder folder;
  save(maps.paged, folder.at("m"));
  EXPECT_LE(maps.paged.memory_bytes(), kCap);
  EXPECT_THROW((void)load(folder.at("m"), {.memory_cap_bytes = kCap}), MapFileError);
  Map again = load(folder.at("m"), {.memory_cap_bytes = kCap, .page_directory = scratch()});
  EXPECT_LE(again.memory_bytes(), kCap);
  EXPECT_EQ(again.hash(), maps.roomy.hash());
  const Scan s = places.place(d->scans[0]);
  again.integrate(s), maps.roomy.integrate(s);
  EXPECT_EQ(again.hash(), maps.roomy.hash());
}

TEST(Paging, WhatOneCallWritesMustFit) {
  const auto d = testing::drive(Model::li2014, 40, 9);
  Pair maps(*d, {.rule = Rule::pcr5}, "serial", scratch());
  Places places(9);
  std::vector<Scan> all;
  for (const Scan& s : d->scans) all.push_back(places.place(s));
  const std::uint64_t before = maps.paged.hash();
  EXPECT_THROW(maps.paged.integrate(all), std::length_error);
  EXPECT_EQ(maps.paged.hash(), before);
  for (const Scan& s : all) maps.both([&](Map& m) { EXPECT_EQ(m.integrate(s).stamps_backwards, 0u); });
  maps.expect_same();
}

TEST(Paging, AFileThatCannotBeMadeOrWrittenIsNamedAndLosesNothing) {
  Map map;
  try {
    map.page_to("/no/such/folder");
    FAIL();
  } catch (const std::system_error& e) {
    EXPECT_NE(std::string(e.what()).find("/no/such/folder"), std::string::npos) << e.what();
  }
  const auto d = testing::drive(Model::li2014, 40, 10);
  Pair maps(*d, {.rule = Rule::pcr5}, "tbb", scratch());
  Places places(10);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{std::size_t{3} << 20, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);  // a disk of three megabytes
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    const Scan s = places.place(d->scans[static_cast<std::size_t>(i % 40)]);
    const std::uint64_t before = maps.paged.hash();
    try {
      maps.paged.integrate(s);
    } catch (const std::system_error& e) {
      EXPECT_NE(std::string(e.what()).find("page file in "), std::string::npos) << e.what();
      ++refused;
      ASSERT_EQ(maps.paged.hash(), before);
      continue;
    }
    maps.roomy.integrate(s);
  }
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_GT(refused, 10);
  ASSERT_EQ(maps.paged.hash(), maps.roomy.hash());
  for (int i = 0; i < 60; ++i) {  // there is room again
    const Scan s = places.place(d->scans[static_cast<std::size_t>(i % 40)]);
    maps.both([&](Map& m) { m.integrate(s); });
  }
  ASSERT_EQ(maps.paged.hash(), maps.roomy.hash());
}

TEST(Paging, AForkedChildLeavesItsParentsTilesAlone) {
  const auto d = testing::drive(Model::li2014, 40, 11);
  Pair maps(*d, {.rule = Rule::pcr5}, "serial", scratch());
  Places places(11);
  for (int i = 0; i < 60; ++i) {
    const Scan s = places.place(d->scans[static_cast<std::size_t>(i % 40)]);
    maps.both([&](Map& m) { m.integrate(s); });
  }
  ASSERT_GT(maps.paged.paged_bytes(), 0u);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    int refused = 0;
    try {
      for (int i = 0; i < 60; ++i) maps.paged.integrate(places.place(d->scans[static_cast<std::size_t>(i % 40)]));
    } catch (const std::system_error&) {
      refused = 1;
    }
    maps.paged.clear();
    _exit(refused == 1 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  maps.expect_same();
}

}  // namespace
}  // namespace evigrid
