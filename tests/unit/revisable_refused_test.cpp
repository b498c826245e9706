// SPDX-License-Identifier: Apache-2.0
// A change that is refused, for want of memory or because the journal takes nothing more, did not happen: neither in
// the map, nor in its scans, nor in what a later run reads in the journal.
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "temp_folder.hpp"
#include "unit/fsync_probe.hpp"
#include "unit/full_disk.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kRoomy = std::size_t{1} << 30;

MapParams capped(std::size_t bytes) { return {.rule = Rule::pcr5, .memory_cap_bytes = bytes}; }
Map new_map(const testing::Drive& d, std::size_t cap = kRoomy) {
  Map map(capped(cap), make_serial_executor());
  for (const Sensor& s : d.sensors) map.add(s);
  return map;
}
/// Scans that lie each by itself, a millisecond apart.
std::vector<Scan> apart(const testing::Drive& d) {
  std::vector<Scan> out(d.scans);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].stamp_ns = 1'000'000 * static_cast<std::int64_t>(i + 1);
    out[i].T_map_robot.x_m += 20.0 * static_cast<double>(i);
  }
  return out;
}
std::size_t memory_of(const testing::Drive& d, std::span<const Scan> scans) {
  Map map = new_map(d);
  map.integrate(scans);
  return map.memory_bytes();
}

/// Hash, and ids and poses in the order of fusion.
struct State {
  std::uint64_t hash;
  std::vector<std::pair<ScanId, double>> scans;
  explicit State(const RevisableMap& map) : hash(map.map().hash()) {
    for (const ScanPose& p : map.poses()) scans.emplace_back(p.id, p.T_map_robot.x_m);
  }
  bool operator==(const State&) const = default;
};
State state_of_journal(const std::string& file, RevisableOptions options = {}) {
  return State(RevisableMap::resume(
      file, {.executor = make_serial_executor(), .kernel = {}, .memory_cap_bytes = kRoomy}, options));
}

/// A map with its journal and all of these scans, whose tiles fill it to the cap.
struct Full {
  std::unique_ptr<testing::Drive> drive = testing::drive(Model::li2014, 8, 3);
  std::vector<Scan> scans = apart(*drive);
  TempFolder dir;
  RevisableOptions options{.reorder_ns = 3'500'000, .checkpoint_every = 0, .most_checkpoints = 0};
  RevisableMap map;
  explicit Full(double cap_of_memory = 1)
      : map(new_map(*drive, static_cast<std::size_t>(cap_of_memory * static_cast<double>(memory_of(*drive, scans)))),
            options, Journal::create(dir.at("j"), capped(kRoomy), drive->sensors)) {
    map.integrate(scans);
  }
  void expect_refused(const std::function<void()>& change) {
    const State before(map);
    EXPECT_THROW(change(), std::length_error);
    EXPECT_EQ(State(map), before);
    EXPECT_EQ(state_of_journal(dir.at("j"), options), before);
  }
};

TEST(RevisableRefused, ScansThatDoNotFitAreNotInTheJournal) {
  const auto d = testing::drive(Model::li2014, 300, 8);
  std::vector<Scan> scans(d->scans);  // near each other, but for the last hundred
  for (std::size_t i = 200; i < 300; ++i) scans[i].T_map_robot.x_m += 20.0 * static_cast<double>(i);
  const TempFolder dir;
  RevisableMap map(new_map(*d, memory_of(*d, std::span(scans).first(200))), {.checkpoint_every = 0},
                   Journal::create(dir.at("j"), capped(kRoomy), d->sensors));
  map.integrate(std::span(scans).first(190));
  EXPECT_THROW(map.integrate(scans[250]), std::length_error);
  EXPECT_EQ(map.scans(), 190u);
  map.integrate(scans[0]);
  EXPECT_THROW(map.integrate(scans), std::length_error);
  EXPECT_EQ(map.scans(), 191u + 128u);  // some are fused before there is no room
  EXPECT_EQ(map.integrate(scans[7]).first, 191u + 128u + 1u);
  EXPECT_EQ(state_of_journal(dir.at("j")), State(map));
}

TEST(RevisableRefused, ScansThatTheJournalDoesNotTakeAreNotInTheMap) {
  const auto d = testing::drive(Model::li2014, 20, 8);
  const TempFolder dir;
  RevisableMap map(new_map(*d), {}, Journal::create(dir.at("j"), capped(kRoomy), d->sensors, {.sync_each = true}));
  map.integrate(d->scans[0]);
  const State before(map);
  {
    const testing::FullDisk full(std::filesystem::file_size(dir.at("j")) + 3000);  // some records and a part of one
    EXPECT_THROW(map.integrate(d->scans), MapFileError);
    EXPECT_EQ(State(map), before);
  }
  testing::FsyncProbe::failing_from = 3;
  EXPECT_THROW(map.integrate(d->scans), MapFileError);
  testing::FsyncProbe::failing_from = -1;
  EXPECT_EQ(State(map), before);
  EXPECT_EQ(state_of_journal(dir.at("j")), before);
  map.integrate(d->scans[5]);
  EXPECT_EQ(state_of_journal(dir.at("j")), State(map));
}

TEST(RevisableRefused, ARemovalThatDoesNotFit) {
  Full f;
  const ScanId id = f.map.poses()[3].id;
  {
    const MapView held = f.map.view();
    f.expect_refused([&] { f.map.remove(id); });
  }
  f.map.remove(id);
  f.scans.erase(f.scans.begin() + 3);
  Map wanted = new_map(*f.drive);
  wanted.integrate(f.scans);
  EXPECT_EQ(f.map.map().hash(), wanted.hash());
  EXPECT_EQ(state_of_journal(f.dir.at("j"), f.options), State(f.map));
}

TEST(RevisableRefused, AMoveThatDoesNotFit) {
  Full f;
  const ScanId id = f.map.poses()[3].id;
  f.expect_refused([&] { f.map.move(id, {0, 900, 0}); });  // no room for tiles there
  {
    const MapView held = f.map.view();
    f.expect_refused([&] { f.map.move(id, f.scans[3].T_map_robot); });  // no room for copies
  }
  f.map.remove(f.map.poses()[0].id);
  f.map.remove(f.map.poses()[1].id);
  {
    const MapView held = f.map.view();  // there is room to reach the tiles, but not to write on all of them
    const std::size_t tiles = f.map.map().tiles();
    f.expect_refused([&] { f.map.move(id, {0, 900, 0}); });
    EXPECT_EQ(f.map.map().tiles(), tiles);
  }
  f.map.move(id, {0, 900, 0});
  EXPECT_EQ(state_of_journal(f.dir.at("j"), f.options), State(f.map));
}

TEST(RevisableRefused, ALateScanThatDoesNotFit) {
  Full f;
  Scan late = f.scans[6];
  late.stamp_ns -= 500'000;
  {
    const MapView held = f.map.view();
    f.expect_refused([&] { f.map.integrate(late); });
  }
  EXPECT_EQ(f.map.integrate(late).sorted_in, 1u);
  f.scans.insert(f.scans.begin() + 6, late);
  Map wanted = new_map(*f.drive);
  wanted.integrate(f.scans);
  EXPECT_EQ(f.map.map().hash(), wanted.hash());
  EXPECT_EQ(state_of_journal(f.dir.at("j"), f.options), State(f.map));
}

TEST(RevisableRefused, ALoopClosureThatDoesNotFitBesideAView) {
  Full f(1.6);
  std::vector<ScanPose> far = f.map.poses(), near = far;
  for (std::size_t i = 0; i < far.size(); ++i) far[i].T_map_robot.y_m += 100.0 * static_cast<double>(i + 1);
  for (ScanPose& p : near) p.T_map_robot.x_m += 0.1;
  {
    const MapView held = f.map.view();
    const std::uint64_t hash = held.hash();
    f.expect_refused([&] { f.map.rebuild(far); });
    f.expect_refused([&] { f.map.rebuild(near); });
    EXPECT_EQ(held.hash(), hash);
  }
  f.map.rebuild(near);
  EXPECT_EQ(state_of_journal(f.dir.at("j"), f.options), State(f.map));
}

/// What comes before all scans is under them again, too.
TEST(RevisableRefused, ALoopClosureOverAMapThatHeldSomething) {
  const auto d = testing::drive(Model::li2014, 8, 3);
  const std::vector<Scan> scans = apart(*d);
  int refused = 0;
  for (const double cap : {1.6, 2.1, 2.3, 2.45, 2.55, 2.9, 3.1}) {
    Map base = new_map(*d, static_cast<std::size_t>(cap * static_cast<double>(memory_of(*d, scans))));
    base.integrate(std::span(scans).first(4));
    RevisableMap map(std::move(base), {.checkpoint_every = 0});
    map.integrate(scans);
    std::vector<ScanPose> far = map.poses();
    for (std::size_t i = 0; i < far.size(); ++i) far[i].T_map_robot.y_m += 100.0 * static_cast<double>(i + 1);
    const MapView held = map.view();
    const State before(map);
    try {
      map.rebuild(far);
      EXPECT_NE(State(map), before);
    } catch (const std::length_error&) {
      EXPECT_EQ(State(map), before) << cap;
      ++refused;
    }
  }
  EXPECT_EQ(refused, 6);
}

}  // namespace
}  // namespace evigrid
