// SPDX-License-Identifier: Apache-2.0
// Policies on a clock of our own: a backlog loses nothing, skipping is counted and can be undone from the log, whatever
// the slices and the threads. No test here looks at real time.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "cycle/replay.hpp"
#include "error.hpp"
#include "fake_fleet.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {
namespace {

constexpr std::uint64_t kAll = 25 * FakeFleet::kRobots;

std::uint64_t unhurried_hash() {
  FakeFleet fleet(fake_map("serial", 1));
  run_cycles(fleet, fake_options(Policy::none));
  return fleet.map.hash();
}

std::vector<std::uint64_t> in_order() {
  std::vector<std::uint64_t> numbers(kAll);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

TEST(CycleLoop, WithoutPolicyEverythingIsFusedAndTimed) {
  FakeFleet fleet(fake_map("serial", 1));
  const CycleResult r = run_cycles(fleet, fake_options(Policy::none));
  ASSERT_EQ(r.rows.size(), 25u);
  EXPECT_EQ(fleet.fused, in_order());
  for (const CycleRow& row : r.rows) {
    EXPECT_NEAR(row.drive_s, 12e-5, 1e-9);
    EXPECT_NEAR(row.cast_s, 12e-4, 1e-9);
    EXPECT_NEAR(row.fuse_s, 12e-3, 1e-9);
    EXPECT_NEAR(row.render_s, 24e-4, 1e-9);
    EXPECT_NEAR(row.whole_s, row.drive_s + row.cast_s + row.fuse_s + row.render_s, 1e-9);
    EXPECT_EQ(row.made, 12u);
    EXPECT_EQ(row.fused, 12u);
    EXPECT_EQ(row.report.readings_used + row.report.refused_total(), 36u);
    EXPECT_FALSE(row.drain);
  }
}

TEST(CycleLoop, ADrainedBacklogIsTheUnhurriedMap) {
  const std::uint64_t hash = unhurried_hash();
  for (const std::string executor : {"tbb", "openmp"}) {
    for (const int threads : {1, 2, 7}) {
      for (const std::size_t slice : {1, 3, 5}) {
        FakeFleet fleet(fake_map(executor, threads));
        CycleOptions o = fake_options(Policy::backlog);
        o.slice = slice;
        const CycleResult r = run_cycles(fleet, o);
        EXPECT_EQ(fleet.map.hash(), hash) << executor << threads << ' ' << slice;
        EXPECT_EQ(fleet.fused, in_order());
        EXPECT_EQ(r.made, kAll);
        EXPECT_EQ(r.fused, kAll);
        EXPECT_EQ(r.thinned + r.cut_short, 0u);
      }
    }
  }
}

TEST(CycleLoop, ABacklogIsBoundedHoldsBackAndKeepsTheDeadline) {
  FakeFleet fleet(fake_map("serial", 1));
  const CycleOptions o = fake_options(Policy::backlog);
  const CycleResult r = run_cycles(fleet, o);
  std::uint64_t made = 0, fused = 0, held = 0;
  ASSERT_GT(r.rows.size(), 25u);
  for (const CycleRow& row : r.rows) {
    made += row.made;
    fused += row.fused;
    held += row.held_back;
    EXPECT_LE(row.backlog, o.backlog);
    EXPECT_EQ(row.backlog, made - fused);
    EXPECT_GT(row.fused, 0u);
    EXPECT_EQ(row.drain, row.cycle >= 25);
    // What a robot is held back for, it still owes: due = made + held back.
    EXPECT_EQ(made + row.held_back, std::min(row.cycle + 1, o.cycles) * FakeFleet::kRobots);
    EXPECT_TRUE(row.cycle == 0 || row.whole_s <= o.deadline_s) << row.cycle;  // the first cycle knows no costs yet
  }
  EXPECT_GT(held, 0u);
  EXPECT_LE(r.most_waiting, o.backlog);
  EXPECT_GT(r.most_waiting, o.backlog / 2);
  EXPECT_EQ(r.rows.back().backlog, 0u);
}

TEST(CycleLoop, FastEnoughAPolicyChangesNothing) {
  for (const Policy policy : {Policy::backlog, Policy::skip}) {
    FakeFleet fleet(fake_map("serial", 1), {1e-7, 1e-7, 1e-6, 1e-7});
    const CycleResult r = run_cycles(fleet, fake_options(policy));
    EXPECT_EQ(r.rows.size(), 25u);
    EXPECT_EQ(fleet.fused, in_order());
    EXPECT_EQ(r.thinned + r.cut_short, 0u);
    for (const CycleRow& row : r.rows) EXPECT_EQ(row.held_back + row.backlog, 0u);
  }
}

TEST(CycleLoop, ACastThatTakesTheWholeCycleDoesNotStopTheMap) {
  for (const Policy policy : {Policy::backlog, Policy::skip}) {
    FakeFleet fleet(fake_map("serial", 1), {0, 1, 1, 0});
    const CycleResult r = run_cycles(fleet, fake_options(policy));
    for (const CycleRow& row : r.rows) EXPECT_GT(row.fused, 0u);
    EXPECT_EQ(r.fused + r.thinned + r.cut_short, kAll);
  }
}

TEST(CycleLoop, SkippedScansAreCountedLoggedAndSharedAmongTheRobots) {
  FakeFleet fleet(fake_map("serial", 1));
  const CycleResult r = run_cycles(fleet, fake_options(Policy::skip));
  ASSERT_EQ(r.rows.size(), 25u);
  std::uint64_t fused = 0, thinned = 0, cut_short = 0, in_time = 0;
  for (const CycleRow& row : r.rows) {
    EXPECT_EQ(row.made, 12u);
    EXPECT_EQ(row.made, row.fused + row.thinned + row.cut_short);
    fused += row.fused;
    thinned += row.thinned;
    cut_short += row.cut_short;
    in_time += row.whole_s <= 0.01 ? 1 : 0;
  }
  EXPECT_EQ(r.fused, fused);
  EXPECT_EQ(r.thinned, thinned);
  EXPECT_EQ(r.cut_short, cut_short);
  EXPECT_GT(thinned, 0u);
  EXPECT_GE(in_time, 23u);  // the first cycle knows no costs yet
  ASSERT_EQ(fleet.logged.size(), kAll);
  std::vector<std::uint64_t> marked;
  std::set<std::uint64_t> robots;
  for (std::uint64_t i = 0; i < kAll; ++i) {
    EXPECT_EQ(fleet.logged[i].first, i);
    if (!fleet.logged[i].second) continue;
    marked.push_back(i);
    robots.insert(i % FakeFleet::kRobots);
  }
  EXPECT_EQ(marked, fleet.fused);
  EXPECT_EQ(robots.size(), FakeFleet::kRobots);
}

TEST(CycleLoop, TheLogGivesBackTheRunsMapAndTheUnhurriedOne) {
  const TempDir dir;
  const std::string path = dir.at("scans.evilog");
  FakeFleet fleet(fake_map("tbb", 2));
  fleet.file = std::make_unique<ScanLogWriter>(path, fleet.map, 3);
  run_cycles(fleet, fake_options(Policy::skip));
  EXPECT_TRUE(dir.names().count("scans.evilog") == 0);
  fleet.file->commit();
  EXPECT_EQ(dir.names(), (std::set<std::string>{"scans.evilog"}));

  const auto replayed = [&](ReplayPart part, const std::string& executor, int threads) {
    return replay(path, part, {std::shared_ptr<Executor>(make_executor(executor, threads)), Kernel::automatic});
  };
  const std::uint64_t unhurried = unhurried_hash();
  for (const int threads : {1, 2, 7}) {
    const Replayed all = replayed(ReplayPart::all, "openmp", threads),
                   fused = replayed(ReplayPart::fused, "openmp", threads),
                   late = replayed(ReplayPart::late, "openmp", threads);
    EXPECT_EQ(all.map.hash(), unhurried);
    EXPECT_EQ(all.scans, kAll);
    EXPECT_EQ(fused.map.hash(), fleet.map.hash());
    EXPECT_EQ(fused.scans, fleet.fused.size());
    EXPECT_EQ(late.scans, kAll);
    EXPECT_NE(late.map.hash(), unhurried);  // PCR5 is not associative: late is another map
    EXPECT_EQ(late.report.cells_updated, all.report.cells_updated);
  }
  // Late is the run's own map, which goes on with what it had skipped.
  ScanLogReader log(path);
  ScanViews views(fleet.map);
  LoggedScan one;
  while (log.next(one))
    if (!one.fused) fleet.map.integrate(views.of({&one.scan, 1}));
  EXPECT_EQ(replayed(ReplayPart::late, "serial", 1).map.hash(), fleet.map.hash());
}

TEST(ScanLog, DamageIsAlwaysToldAndNamesTheFile) {
  const TempDir dir;
  {
    FakeFleet fleet(fake_map("serial", 1));
    fleet.file = std::make_unique<ScanLogWriter>(dir.at("log"), fleet.map, 3);
    CycleOptions o = fake_options(Policy::none);
    o.cycles = 1;
    run_cycles(fleet, o);
    fleet.file->commit();
  }
  const std::string good = slurp(dir.at("log"));
  const auto told = [&](const std::string& bytes) {
    const std::string path = dir.write("bad", bytes);
    try {
      ScanLogReader log(path);
      LoggedScan one;
      while (log.next(one)) {
      }
    } catch (const InputError& error) {
      return std::string(error.what()).find(path) != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(told(good));
  for (std::size_t n = 0; n < good.size(); n += 5) ASSERT_TRUE(told(good.substr(0, n))) << n;
  for (std::size_t n = 0; n < good.size(); n += 5) {
    std::string bad = good;
    bad[n] = static_cast<char>(bad[n] ^ (1 << n % 8));
    ASSERT_TRUE(told(bad)) << n;
  }
  EXPECT_THROW(ScanLogReader(dir.at("none")), InputError);
}

TEST(ScanLog, WithoutCommitNothingStays) {
  const TempDir dir;
  {
    const Map map = fake_map("serial", 1);
    ScanLogWriter log(dir.at("log"), map, 3);
  }
  EXPECT_EQ(dir.names(), std::set<std::string>{});
  const Map map = fake_map("serial", 1);
  EXPECT_THROW(ScanLogWriter(dir.at("no/such/folder"), map, 3), InputError);
}

}  // namespace
}  // namespace evigrid::driver
