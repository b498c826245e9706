// SPDX-License-Identifier: Apache-2.0
// The journal: what was written comes back to the bit; a tail that was cut off, at any byte, costs the one record that
// was being written and is said; damage elsewhere is an error; a process that is killed loses nothing it was told of.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "sanitizer.hpp"
#include "temp_folder.hpp"

namespace evigrid {
namespace {

std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
JournalContents parse(const std::string& bytes) { return read_journal(std::as_bytes(std::span(bytes)), "j"); }
bool same(const Scan& a, const Scan& b) {
  if (a.stamp_ns != b.stamp_ns || std::memcmp(&a.T_map_robot, &b.T_map_robot, sizeof(Pose2)) != 0 ||
      a.readings.size() != b.readings.size())
    return false;
  for (std::size_t i = 0; i < a.readings.size(); ++i) {
    const Reading &p = a.readings[i], &q = b.readings[i];
    if (p.sensor != q.sensor || p.ranges_m.size() != q.ranges_m.size() ||
        std::memcmp(p.ranges_m.data(), q.ranges_m.data(), p.ranges_m.size_bytes()) != 0)
      return false;
  }
  return true;
}
Map new_map(const testing::Drive& d, std::shared_ptr<Executor> executor = make_serial_executor()) {
  Map map({.rule = Rule::pcr5}, std::move(executor));
  for (const Sensor& s : d.sensors) map.add(s);
  return map;
}

TEST(Journal, WhatWasWrittenComesBackToTheBit) {
  const auto d = testing::drive(Model::li2014, 12, 4);
  const float odd[4]{NAN, INFINITY, -INFINITY, -0.0f};
  const Reading strange{99, odd};
  for (const bool compress : {false, true}) {
    const TempFolder dir;
    const Map map = new_map(*d);
    {
      Journal j = Journal::create(dir.at("j"), map.params(), map.sensors(), {.compress = compress});
      for (std::size_t i = 0; i < 12; ++i) j.add(i + 1, d->scans[i]);
      j.add(13, Scan{-5, {NAN, 1e300, -0.0}, {&strange, 1}});
      j.add(14, Scan{});
      j.move(3, {1, -2, 0.5});
      j.remove(7);
      EXPECT_EQ(j.bytes(), std::filesystem::file_size(dir.at("j")));
    }
    const JournalContents c = read_journal(dir.at("j"));
    EXPECT_EQ(c.dropped, 0u);
    ASSERT_EQ(c.events.size(), 16u);
    ASSERT_EQ(c.sensors.size(), d->sensors.size());
    EXPECT_EQ(c.params.rule, Rule::pcr5);
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_EQ(c.events[i].id, i + 1);
      EXPECT_TRUE(same(c.events[i].scan.scan(), d->scans[i]));
    }
    EXPECT_TRUE(same(c.events[12].scan.scan(), Scan{-5, {NAN, 1e300, -0.0}, {&strange, 1}}));
    EXPECT_TRUE(same(c.events[13].scan.scan(), Scan{}));
    EXPECT_EQ(c.events[14].kind, JournalEvent::Kind::move);
    EXPECT_EQ(c.events[14].T_map_robot.y_m, -2);
    EXPECT_EQ(c.events[15].kind, JournalEvent::Kind::remove);
    EXPECT_EQ(c.events[15].id, 7u);
    EXPECT_THROW(Journal::create(dir.at("j"), map.params(), map.sensors()), MapFileError);  // never over another
  }
}

TEST(Journal, ACutTailIsDroppedAtAnyByteAndDamageIsFound) {
  const auto d = testing::drive(Model::li2014, 4, 4);
  const TempFolder dir;
  const Map map = new_map(*d);
  std::vector<std::uint64_t> ends;
  {
    Journal j = Journal::create(dir.at("j"), map.params(), map.sensors());
    ends.push_back(j.bytes());
    for (std::size_t i = 0; i < 4; ++i) j.add(i + 1, d->scans[i]), ends.push_back(j.bytes());
  }
  const std::string whole = slurp(dir.at("j"));
  for (std::size_t n = ends[0]; n <= whole.size(); ++n) {
    const JournalContents c = parse(whole.substr(0, n));
    const auto records = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), n) - ends.begin()) - 1;
    ASSERT_EQ(c.events.size(), records) << n;
    ASSERT_EQ(c.bytes, ends[records]);
    ASSERT_EQ(c.dropped, n - ends[records]);
  }
  for (std::size_t n = 0; n < ends[0]; ++n) ASSERT_THROW(parse(whole.substr(0, n)), MapFileError) << n;
  EXPECT_EQ(parse(whole + std::string(4096, '\0')).dropped, 4096u);  // what some file systems leave
  // One bit anywhere: an error that names the place, or, where it is the length that grew beyond the file or the last
  // record, a tail that is dropped; never another scan.
  std::size_t errors = 0;
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    try {
      const JournalContents c = parse(bad);
      ASSERT_GT(c.dropped, 0u) << at;
      for (std::size_t i = 0; i < c.events.size(); ++i) ASSERT_TRUE(same(c.events[i].scan.scan(), d->scans[i])) << at;
    } catch (const MapFileError& e) {
      ++errors;
      if (at >= ends[0]) {
        EXPECT_NE(std::string(e.what()).find("record at byte"), std::string::npos) << e.what();
      }
    }
  }
  EXPECT_GT(errors, whole.size() / 7 / 2);
  EXPECT_THROW((void)read_journal(dir.path()), MapFileError);
  EXPECT_THROW((void)read_journal(dir.at("none")), MapFileError);
}

TEST(Journal, GoesOnBehindACutTail) {
  const auto d = testing::drive(Model::li2014, 4, 4);
  const TempFolder dir;
  const Map map = new_map(*d);
  {
    Journal j = Journal::create(dir.at("j"), map.params(), map.sensors());
    j.add(1, d->scans[0]);
    j.add(2, d->scans[1]);
  }
  std::filesystem::resize_file(dir.at("j"), std::filesystem::file_size(dir.at("j")) - 3);
  const JournalContents c = read_journal(dir.at("j"));
  EXPECT_EQ(c.events.size(), 1u);
  EXPECT_GT(c.dropped, 0u);
  Journal j = Journal::append(dir.at("j"), c, {.sync_each = true});
  j.add(2, d->scans[2]);
  const JournalContents now = read_journal(dir.at("j"));
  ASSERT_EQ(now.events.size(), 2u);
  EXPECT_EQ(now.dropped, 0u);
  EXPECT_TRUE(same(now.events[1].scan.scan(), d->scans[2]));
}

/// A child fuses and journals and says on a pipe which scan it has been through; it is killed at any moment. What it
/// had said is there, the map is that of what is there, and the run goes on to the map of an undisturbed one.
TEST(Journal, AKilledRunLosesNothing) {
  if (testing::kThreadSanitizer) GTEST_SKIP() << "the thread sanitizer and fork do not go together";
  const auto d = testing::drive(Model::li2014, 40, 9);
  Map undisturbed = new_map(*d);
  for (int round = 0; round < 5; ++round) undisturbed.integrate(d->scans);
  for (const int wait_us : {0, 500, 3000, 9000, 20000}) {
    const TempFolder dir;
    int said[2];
    ASSERT_EQ(pipe(said), 0);
    const pid_t child = fork();
    if (child == 0) {
      RevisableMap map(new_map(*d), {}, Journal::create(dir.at("j"), {.rule = Rule::pcr5}, d->sensors));
      for (int round = 0; round < 5; ++round) {
        for (std::size_t i = 0; i < 40; ++i) {
          map.integrate(d->scans[i]);
          const char one = 1;
          if (write(said[1], &one, 1) != 1) _exit(1);
        }
      }
      pause();
      _exit(0);
    }
    close(said[1]);
    char first = 0;
    ASSERT_EQ(read(said[0], &first, 1), 1);
    usleep(static_cast<useconds_t>(wait_us));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    std::size_t told = 1;
    std::vector<char> more(4096);
    for (ssize_t n = 0; (n = read(said[0], more.data(), more.size())) > 0;) told += static_cast<std::size_t>(n);
    close(said[0]);
    RevisableMap map = RevisableMap::resume(dir.at("j"), {.executor = make_serial_executor()});
    ASSERT_GE(map.scans(), told);
    ASSERT_LE(map.scans(), told + 1);  // recorded, then killed before it could say so
    Map wanted = new_map(*d);
    for (std::size_t i = 0; i < map.scans(); ++i) wanted.integrate(d->scans[i % 40]);
    EXPECT_EQ(map.map().hash(), wanted.hash());
    for (std::size_t i = map.scans(); i < 200; ++i) map.integrate(d->scans[i % 40]);
    EXPECT_EQ(map.map().hash(), undisturbed.hash()) << told;
    EXPECT_EQ(read_journal(dir.at("j")).events.size(), 200u);
  }
}

}  // namespace
}  // namespace evigrid
