// SPDX-License-Identifier: Apache-2.0
// A map that changes its mind, against a map fused from nothing with the scans as they are then: equal cells, history
// and last stamp, for rules that have no way of taking anything back.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "temp_folder.hpp"

namespace evigrid {
namespace {

Map new_map(const testing::Drive& d, MapParams params = {.rule = Rule::pcr5},
            std::shared_ptr<Executor> executor = make_serial_executor()) {
  Map map(params, std::move(executor));
  for (const Sensor& s : d.sensors) map.add(s);
  return map;
}
/// Scan i, far from most others.
Scan far_scan(const testing::Drive& d, std::size_t i) {
  Scan s = d.scans[i];
  s.stamp_ns = 1'000'000 * static_cast<std::int64_t>(i);
  s.T_map_robot.x_m += 5.0 * static_cast<double>(i % 9);
  s.T_map_robot.y_m -= 5.0 * static_cast<double>(i % 4);
  return s;
}
/// All that can be told of a map's cells: masses by the hash, history by its layers, box. Not tiles of
/// which no cell was ever changed: those that a map has depend on how it came to be.
std::string told(const Map& map) {
  std::ostringstream out;
  const CellRect b = map.bounds();
  out << map.hash() << ' ' << b.x << ' ' << b.y << ' ' << b.width << ' ' << b.height << ' ';
  std::vector<float> plane(static_cast<std::size_t>(b.width * b.height));
  for (const Layer layer : {Layer::conflict, Layer::con}) {
    map.render(layer, b, plane, b.width);
    std::uint64_t h = 0;
    for (const float f : plane) h = h * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(f) + (h >> 40);
    out << h << ' ';
  }
  return out.str();
}
/// "last_stamp_ns=…" of the file's header.
std::string stamp_of(const Map& map) {
  std::ostringstream file;
  save(map, file);
  const std::string bytes = file.str(), key = "last_stamp_ns=";
  const std::size_t at = bytes.find(key);
  return at == std::string::npos ? "never" : bytes.substr(at, bytes.find('\n', at) - at);
}
/// From nothing, one scan a call.
std::string told_of_scans(const testing::Drive& d, const std::vector<Scan>& scans,
                          MapParams params = {.rule = Rule::pcr5}) {
  Map map = new_map(d, params);
  for (const Scan& s : scans) map.integrate(s);
  return told(map);
}

TEST(Revisable, RemovedAndMovedScansLeaveTheMapWithoutThem) {
  const auto d = testing::drive(Model::li2014, 20, 12);
  for (const MapParams params : {MapParams{.rule = Rule::pcr5, .keep_con = true}, MapParams{.rule = Rule::dempster},
                                 MapParams{.rule = Rule::murphy}, MapParams{.rule = Rule::bayes},
                                 MapParams{.rule = Rule::pcr5, .decay_s = 0.01}}) {
    for (const std::size_t checkpoint_every : {std::size_t{0}, std::size_t{5}}) {
      RevisableMap map(new_map(*d, params), {.checkpoint_every = checkpoint_every});
      std::vector<Scan> scans;
      std::vector<ScanId> ids;
      for (std::size_t i = 0; i < 20; ++i) {
        scans.push_back(far_scan(*d, i));
        ids.push_back(map.integrate(scans.back()).first);
      }
      ASSERT_EQ(told(map.map()), told_of_scans(*d, scans, params));
      std::mt19937 random(3);
      for (int change = 0; change < 5; ++change) {
        const std::size_t i = random() % scans.size();
        if (change % 3 == 0) {
          const RevisableMap::Revision r = map.remove(ids[i]);
          scans.erase(scans.begin() + static_cast<std::ptrdiff_t>(i));
          ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(i));
          EXPECT_LT(r.tiles, map.map().tiles());
          EXPECT_LT(r.scans, scans.size());
        } else {
          scans[i].T_map_robot.x_m += 0.3 * change - 1;
          scans[i].T_map_robot.yaw_rad += 0.1;
          map.move(ids[i], scans[i].T_map_robot);
        }
        ASSERT_EQ(told(map.map()), told_of_scans(*d, scans, params)) << name(params.rule) << change;
      }
      Map wanted = new_map(*d, params);
      for (const Scan& s : scans) wanted.integrate(s);
      EXPECT_EQ(stamp_of(map.map()), stamp_of(wanted));
      // And on: as if nothing had happened.
      scans.push_back(far_scan(*d, 5));
      map.integrate(scans.back());
      ASSERT_EQ(told(map.map()), told_of_scans(*d, scans, params));
    }
  }
}

TEST(Revisable, EveryScanTakenBackIsAnEmptyMapWithoutMemory) {
  const auto d = testing::drive(Model::li2014, 10, 1);
  RevisableMap map(new_map(*d), {.checkpoint_every = 3});
  std::vector<ScanId> ids;
  for (const Scan& s : d->scans) ids.push_back(map.integrate(s).first);
  std::shuffle(ids.begin(), ids.end(), std::mt19937(5));
  for (const ScanId id : ids) map.remove(id);
  EXPECT_EQ(map.map().tiles(), 0u);
  EXPECT_EQ(map.map().memory_bytes(), 0u);
  EXPECT_EQ(map.map().hash(), new_map(*d).hash());
  EXPECT_THROW(map.remove(ids[0]), std::out_of_range);
  EXPECT_THROW(map.move(12345, {}), std::out_of_range);
}

TEST(Revisable, ALoopClosureIsTheMapOfTheNewPoses) {
  const auto d = testing::drive(Model::li2014, 300, 2);
  RevisableMap map(new_map(*d));
  std::vector<Scan> scans(d->scans);
  map.integrate(scans);
  std::vector<ScanPose> poses = map.poses();
  ASSERT_EQ(poses.size(), 300u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Pose2& p = poses[i].T_map_robot;
    p = compose({0.01 * static_cast<double>(i), -0.2, 0.001 * static_cast<double>(i)}, p);
    scans[i].T_map_robot = p;
  }
  std::shuffle(poses.begin(), poses.end(), std::mt19937(1));
  map.rebuild(poses);
  EXPECT_EQ(told(map.map()), told_of_scans(*d, scans));
  map.remove(map.poses()[200].id);
  scans.erase(scans.begin() + 200);
  EXPECT_EQ(told(map.map()), told_of_scans(*d, scans));
}

TEST(Revisable, LateScansWithinTheWindowGiveTheSortedLog) {
  const auto d = testing::drive(Model::li2014, 120, 6);
  constexpr std::int64_t kWindow = 10;
  std::vector<Scan> sorted;
  for (std::size_t i = 0; i < 120; ++i) {
    sorted.push_back(far_scan(*d, i));
    sorted.back().stamp_ns = static_cast<std::int64_t>(i) / 2 * 2;  // pairs of equal stamps keep their order
  }
  // Late by up to nine, equal stamps in order.
  std::vector<Scan> came = sorted;
  std::mt19937 random(4);
  std::vector<std::pair<std::int64_t, std::size_t>> arrival;
  for (std::size_t i = 0; i < came.size(); ++i)
    arrival.emplace_back(sorted[i].stamp_ns + static_cast<std::int64_t>((random() + i / 2 * 0) % 9), i);
  for (std::size_t i = 1; i < came.size(); i += 2) arrival[i].first = std::max(arrival[i].first, arrival[i - 1].first);
  std::stable_sort(arrival.begin(), arrival.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < came.size(); ++i) came[i] = sorted[arrival[i].second];
  ASSERT_FALSE(std::is_sorted(came.begin(), came.end(), [](auto& a, auto& b) { return a.stamp_ns < b.stamp_ns; }));
  for (const std::size_t batch : {1u, 7u, 120u}) {
    RevisableMap map(new_map(*d), {.reorder_ns = kWindow});
    std::uint64_t sorted_in = 0;
    for (std::size_t i = 0; i < came.size(); i += batch) {
      const auto part = std::span(came).subspan(i, std::min(batch, came.size() - i));
      const RevisableMap::Added a = map.integrate(part);
      sorted_in += a.sorted_in;
      EXPECT_EQ(a.too_late, 0u);
    }
    EXPECT_GT(sorted_in, 20u);
    EXPECT_EQ(told(map.map()), told_of_scans(*d, sorted)) << batch;
  }
  // Without a window, and later than it: as they come, as a Map does, and counted.
  RevisableMap as_they_come(new_map(*d));
  as_they_come.integrate(came);
  EXPECT_EQ(told(as_they_come.map()), told_of_scans(*d, came));
  RevisableMap map(new_map(*d), {.reorder_ns = kWindow});
  map.integrate(std::span(sorted).subspan(20, 40));
  EXPECT_EQ(map.integrate(sorted[3]).too_late, 1u);
  std::vector<Scan> wanted(sorted.begin() + 20, sorted.begin() + 60);
  wanted.push_back(sorted[3]);
  EXPECT_EQ(told(map.map()), told_of_scans(*d, wanted));
}

TEST(Revisable, AMapThatHeldSomethingKeepsItUnderAll) {
  const auto d = testing::drive(Model::li2014, 20, 7);
  Map base = new_map(*d);
  base.integrate(std::span(d->scans).first(8));
  const std::uint64_t before = base.hash();
  RevisableMap map(std::move(base));
  std::vector<ScanId> ids;
  for (std::size_t i = 8; i < 20; ++i) ids.push_back(map.integrate(d->scans[i]).first);
  map.remove(ids[4]);
  std::vector<Scan> scans(d->scans);
  scans.erase(scans.begin() + 12);
  EXPECT_EQ(told(map.map()), told_of_scans(*d, scans));
  map.rebuild({});
  EXPECT_EQ(told(map.map()), told_of_scans(*d, scans));
  for (const ScanId id : ids) {
    if (id != ids[4]) map.remove(id);
  }
  EXPECT_EQ(map.map().hash(), before);
  Map held = new_map(*d);
  held.integrate(d->scans[0]);
  const TempFolder dir;
  EXPECT_THROW(RevisableMap(std::move(held), {}, Journal::create(dir.at("j"), {}, {})), std::invalid_argument);
}

TEST(Revisable, AConsumerOfChangesAndViewsSeesTheRevision) {
  const auto d = testing::drive(Model::li2014, 30, 3);
  RevisableMap map(new_map(*d));
  std::vector<ScanId> ids;
  for (std::size_t i = 0; i < 30; ++i) ids.push_back(map.integrate(far_scan(*d, i)).first);
  const CellRect window{-200, -500, 1200, 800};
  std::vector<std::uint8_t> drawn(static_cast<std::size_t>(window.width * window.height)), whole = drawn;
  map.map().render(Costmap{}, window, drawn, window.width);
  const MapView before = map.view();
  const std::uint64_t hash = map.map().hash();
  for (const ScanId id : {ids[3], ids[29], ids[11]}) {
    const std::uint64_t version = map.map().version();
    map.remove(id);
    const MapView view = map.view();
    for (const CellRect& r : view.changes(version).rects) {
      view.render(Costmap{}, r,
                  std::span(drawn).subspan(static_cast<std::size_t>((r.y - window.y) * window.width + r.x - window.x)),
                  window.width);
    }
    map.map().render(Costmap{}, window, whole, window.width);
    EXPECT_TRUE(whole == drawn);
  }
  EXPECT_EQ(before.hash(), hash);
}

TEST(Revisable, AJournalTellsTheWholeStory) {
  const auto d = testing::drive(Model::li2014, 60, 8);
  const TempFolder dir;
  const RevisableOptions options{.reorder_ns = 10'000'000};
  std::string story;
  std::vector<ScanPose> poses;
  {
    RevisableMap map(new_map(*d), options, Journal::create(dir.at("j"), {.rule = Rule::pcr5}, d->sensors));
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < 60; ++i) scans.push_back(far_scan(*d, i));
    std::swap(scans[30], scans[33]);
    std::vector<ScanId> ids;
    for (const Scan& s : scans) ids.push_back(map.integrate(s).first);
    map.remove(ids[7]);
    map.move(ids[20], {1, 2, 3});
    map.rebuild(std::vector<ScanPose>{{ids[1], {0.5, 0.5, 0}}, {ids[50], {-1, 0, 1}}});
    map.integrate(far_scan(*d, 2));
    story = told(map.map());
    poses = map.poses();
  }
  std::uint64_t dropped = 1;
  RevisableMap map = RevisableMap::resume(dir.at("j"), {.executor = make_openmp_executor(2)}, options, {}, &dropped);
  EXPECT_EQ(dropped, 0u);
  EXPECT_EQ(told(map.map()), story);
  ASSERT_EQ(map.poses().size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(map.poses()[i].id, poses[i].id);
  map.remove(poses[3].id);
  RevisableMap again = RevisableMap::resume(dir.at("j"), {.executor = make_serial_executor()}, options);
  EXPECT_EQ(told(again.map()), told(map.map()));
}

TEST(Revisable, AScanThatCameTooLateDoesNotHideItsNeighbours) {
  const auto d = testing::drive(Model::li2014, 6, 6);
  const auto at = [&](std::size_t i, std::int64_t stamp) {  // all on the same cells
    Scan s = d->scans[i];
    s.T_map_robot = {};
    s.stamp_ns = stamp;
    return s;
  };
  const TempFolder dir;
  RevisableMap map(new_map(*d), {.reorder_ns = 10}, Journal::create(dir.at("j"), {.rule = Rule::pcr5}, d->sensors));
  for (const Scan& s : {at(0, 10), at(1, 20), at(2, 30)}) map.integrate(s);
  EXPECT_EQ(map.integrate(at(3, 1)).too_late, 1u);
  EXPECT_EQ(map.integrate(at(4, 25)).sorted_in, 1u);
  EXPECT_EQ(told(map.map()), told_of_scans(*d, {at(0, 10), at(1, 20), at(4, 25), at(2, 30), at(3, 1)}));
  map.integrate(at(5, 35));
  EXPECT_EQ(map.integrate(at(0, 32)).sorted_in, 1u);
  EXPECT_EQ(told(map.map()),
            told_of_scans(*d, {at(0, 10), at(1, 20), at(4, 25), at(2, 30), at(3, 1), at(0, 32), at(5, 35)}));
  const RevisableMap again =
      RevisableMap::resume(dir.at("j"), {.executor = make_serial_executor()}, {.reorder_ns = 10});
  EXPECT_EQ(told(again.map()), told(map.map()));
}

TEST(Revisable, StampsAtBothEndsOfTimeAreFarApart) {
  const auto d = testing::drive(Model::li2014, 2, 6);
  constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4 * 3;
  RevisableMap map(new_map(*d), {.reorder_ns = 10});
  Scan s = d->scans[0];
  s.stamp_ns = kFar;
  map.integrate(s);
  s.stamp_ns = -kFar;
  EXPECT_EQ(map.integrate(s).too_late, 1u);
}

TEST(Revisable, AMapThatForgetsDoesNotGoBackInTime) {
  const auto d = testing::drive(Model::li2014, 3, 6);
  constexpr std::int64_t kSecond = 1'000'000'000;
  const MapParams params{.rule = Rule::pcr5, .decay_s = 20};
  const auto at = [&](std::size_t i, std::int64_t stamp) {
    Scan s = d->scans[i];
    s.stamp_ns = stamp;
    return s;
  };
  Map base = new_map(*d, params), wanted = new_map(*d, params);
  base.integrate(at(0, 100 * kSecond));
  for (const Scan& s : {at(0, 100 * kSecond), at(2, 50 * kSecond)}) wanted.integrate(s);
  RevisableMap map(std::move(base));
  const ScanId id = map.integrate(at(1, 50 * kSecond)).first;
  map.integrate(at(2, 50 * kSecond));
  map.remove(id);
  EXPECT_EQ(stamp_of(map.map()), stamp_of(wanted));
  EXPECT_EQ(told(map.map()), told(wanted));
}

TEST(Revisable, AJournalLargerThanMemoryIsResumedIntoAPageFile) {
  const auto d = testing::drive(Model::li2014, 150, 8);
  const TempFolder dir;
  std::vector<Scan> scans(d->scans);
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i].T_map_robot.x_m += 2.0 * static_cast<double>(i);
  Map wanted = new_map(*d);
  wanted.integrate(scans);
  {
    Journal j = Journal::create(dir.at("j"), wanted.params(), wanted.sensors());
    for (std::size_t i = 0; i < scans.size(); ++i) j.add(i + 1, scans[i]);
  }
  const std::size_t cap = wanted.memory_bytes() / 4;
  EXPECT_THROW(RevisableMap::resume(dir.at("j"), {.memory_cap_bytes = cap}), std::length_error);
  std::uint64_t read = 0;
  RevisableMap map = RevisableMap::resume(dir.at("j"), {.executor = make_serial_executor(),
                                                        .kernel = {},
                                                        .memory_cap_bytes = cap,
                                                        .page_directory = dir.path(),
                                                        .region = {},
                                                        .bytes_read = &read});
  EXPECT_EQ(read, std::filesystem::file_size(dir.at("j")));
  EXPECT_EQ(map.map().hash(), wanted.hash());
  EXPECT_LE(map.map().memory_bytes(), cap);
  EXPECT_GT(map.map().paged_bytes(), cap);
  map.rebuild({});
  EXPECT_EQ(map.map().hash(), wanted.hash());
  const std::size_t least = std::size_t{3} << 16;  // one scan alone reaches more
  EXPECT_THROW(RevisableMap::resume(dir.at("j"), {.memory_cap_bytes = least, .page_directory = dir.path()}),
               std::length_error);
  EXPECT_THROW(RevisableMap::resume(dir.at("j"), {.region = CellRect{0, 0, 10, 10}}), std::invalid_argument);
  EXPECT_THROW(RevisableMap::resume(dir.at("j"), {.page_directory = "/no/such/folder"}), std::system_error);
}

/// A base larger than the cap goes back under the scans piece by piece.
TEST(Revisable, ALoopClosureOverAMapLargerThanMemory) {
  const auto d = testing::drive(Model::li2014, 60, 8);
  const TempFolder dir;
  std::vector<Scan> scans(d->scans);
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i].T_map_robot.x_m += 4.0 * static_cast<double>(i);
  Map wanted = new_map(*d);
  wanted.integrate(scans);
  Map base = new_map(*d, {.rule = Rule::pcr5, .memory_cap_bytes = wanted.memory_bytes() / 4});
  base.page_to(dir.path());
  for (const Scan& s : scans) base.integrate(s);
  RevisableMap map(std::move(base));
  for (const Scan& s : scans) map.integrate(s);
  wanted.integrate(scans);
  std::vector<ScanPose> poses = map.poses();
  EXPECT_EQ(map.map().hash(), wanted.hash());
  map.rebuild(poses);
  EXPECT_EQ(map.map().hash(), wanted.hash());
}

TEST(Revisable, AJournalIsRefusedWhereReadingsMayNotWriteEverywhere) {
  const auto d = testing::drive(Model::li2014, 1, 6);
  const TempFolder dir;
  Map with_window = new_map(*d), with_area = new_map(*d);
  with_window.set_window({0, 0, 200, 200});
  with_area.protect({0, 0, 200, 200});
  const auto journal = [&](const char* name) {
    return Journal::create(dir.at(name), {.rule = Rule::pcr5}, d->sensors);
  };
  EXPECT_THROW(RevisableMap(std::move(with_window), {}, journal("window")), std::invalid_argument);
  EXPECT_THROW(RevisableMap(std::move(with_area), {}, journal("area")), std::invalid_argument);
}

TEST(Revisable, AtTheMemoryCapALoopClosureIsRefusedWhole) {
  const auto d = testing::drive(Model::li2014, 10, 1);
  Map measure = new_map(*d);
  measure.integrate(d->scans);
  RevisableMap map(new_map(*d, {.rule = Rule::pcr5, .memory_cap_bytes = 2 * measure.memory_bytes()}),
                   {.checkpoint_every = 0});
  map.integrate(d->scans);
  const std::uint64_t before = map.map().hash();
  std::vector<ScanPose> poses = map.poses();
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].T_map_robot.x_m += 100.0 * static_cast<double>(i);
  EXPECT_THROW(map.rebuild(poses), std::length_error);
  EXPECT_EQ(map.map().hash(), before);
  EXPECT_EQ(map.poses()[4].T_map_robot.x_m, d->scans[4].T_map_robot.x_m);
}

}  // namespace
}  // namespace evigrid
