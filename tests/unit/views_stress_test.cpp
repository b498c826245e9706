// SPDX-License-Identifier: Apache-2.0
// One writer at full speed and four readers that never wait for it: a planner that redraws what changed, a saver, one
// that hashes, one that reads cells. The hash of every version is known beforehand from a map without views. Meant for
// the thread sanitizer (preset tsan), true without.
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <thread>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "sanitizer.hpp"

namespace evigrid {
namespace {

constexpr int kRounds = testing::kThreadSanitizer ? 60 : 400;
constexpr CellRect kWindow{-100, -100, 300, 300};

/// What the writer does in round i; the same on any map.
void write(Map& map, const testing::Drive& d, int i) {
  Scan scan = d.scans[static_cast<std::size_t>(i) % d.scans.size()];
  scan.T_map_robot.x_m += 2.5 * (i % 6);
  if (i % 97 == 96) map.clear();
  if (i % 11 == 10) map.set_window({-100 + 8 * (i % 20), -80, 300, 220});  // recentres
  if (i % 13 == 12) map.clear({-20, -20, 90, 50});
  map.integrate(scan);
}

Map new_map(const testing::Drive& d, std::shared_ptr<Executor> executor) {
  Map map({.cell_m = 0.1}, std::move(executor));
  for (const Sensor& s : d.sensors) map.add(s);
  return map;
}

TEST(ViewsStress, FourReadersBesideAWriter) {
  const auto d = testing::drive(Model::li2014, 30, 8);
  std::vector<std::uint64_t> hash_at;  // by version
  {
    Map map = new_map(*d, make_serial_executor());
    for (int i = 0; i < kRounds; ++i) {
      write(map, *d, i);
      hash_at.resize(map.version() + 1);  // of those on the way nobody sees one
      hash_at.back() = map.hash();
    }
  }
  LatestView latest;
  std::atomic<bool> done = false;
  std::atomic<int> looked = 0, wrong = 0;
  const auto reader = [&](auto&& look) {
    return std::thread([&, look]() mutable {
      std::uint64_t last = 0;
      while (!done) {
        const auto view = latest.get();
        if (!view || view->version() == last) {
          std::this_thread::yield();
          continue;
        }
        last = view->version();
        if (!look(*view)) ++wrong;
        ++looked;
      }
    });
  };
  const auto right = [&](const MapView& view) { return view.hash() == hash_at[view.version()]; };
  std::vector<std::thread> readers;
  readers.push_back(reader(right));
  readers.push_back(reader([&](const MapView& view) {  // the saver
    std::ostringstream out;
    save(view, out);
    const std::string bytes = out.str();
    return load(std::as_bytes(std::span(bytes)), {.executor = make_serial_executor()}).hash() ==
           hash_at[view.version()];
  }));
  std::vector<std::uint8_t> costs(static_cast<std::size_t>(kWindow.width * kWindow.height), 255);
  readers.push_back(reader([&, version = std::uint64_t{0}](const MapView& view) mutable {  // the planner
    const Changes changes = view.changes(version);
    version = changes.version;
    if (changes.cleared) std::fill(costs.begin(), costs.end(), std::uint8_t{255});
    for (CellRect r : changes.rects) {
      const std::int64_t x1 = std::min(r.x + r.width, kWindow.x + kWindow.width),
                         y1 = std::min(r.y + r.height, kWindow.y + kWindow.height);
      r.x = std::max(r.x, kWindow.x), r.y = std::max(r.y, kWindow.y);
      r.width = x1 - r.x, r.height = y1 - r.y;
      if (r.empty()) continue;
      view.render(
          Costmap{}, r,
          std::span(costs).subspan(static_cast<std::size_t>((r.y - kWindow.y) * kWindow.width + r.x - kWindow.x)),
          kWindow.width);
    }
    std::vector<std::uint8_t> whole(costs.size());
    view.render(Costmap{}, kWindow, whole, kWindow.width);
    return whole == costs;
  }));
  readers.push_back(reader([&](const MapView& view) {  // reads cells, and keeps a view for longer
    const MapView copy = view;
    float sum = 0;
    for (std::int64_t i = 0; i < 2000; ++i) {
      const Mass m = copy.mass({i % 300 - 100, i / 7 - 100});
      sum += m.e + m.o + m.u;
    }
    return sum > 1990 && right(copy);
  }));
  Map map = new_map(*d, make_spinning_executor(2));
  for (int i = 0; i < kRounds; ++i) {
    write(map, *d, i);
    if (i % 3 != 2) latest.set(map.view());
    if (i % 40 == 39) latest.reset();
    if (i % 5 == 4) std::this_thread::yield();
  }
  latest.set(map.view());
  while (looked < 8) std::this_thread::yield();
  done = true;
  for (std::thread& t : readers) t.join();
  latest.reset();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(map.hash(), hash_at.back());
  EXPECT_EQ(map.memory_bytes(), map.tiles() * (64 * 64 * 4 * sizeof(float)));
}

}  // namespace
}  // namespace evigrid
