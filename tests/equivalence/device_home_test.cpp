// SPDX-License-Identifier: Apache-2.0
// What a device alone knows: it stays there until someone reads it, whoever reads sees it, and when it cannot come back
// the map says so instead of showing what it was before.
#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "equivalence/on_device.hpp"
#include "evigrid/merge.hpp"
#include "evigrid/view.hpp"

namespace evigrid {
namespace {

/// Counts what comes back, and fails where it is told to.
class Watched final : public kernels::Device {
 public:
  struct Log {
    std::size_t fetched = 0, rendered = 0;  // tiles
    bool no_memory = false, lost = false, no_way_back = false;
  };
  Watched(std::unique_ptr<kernels::Device> device, Log& log) : real_(std::move(device)), log_(log) {}
  [[nodiscard]] std::string name() const override { return real_->name(); }
  float* take(std::size_t bytes) override { return real_->take(bytes); }
  void release() noexcept override { real_->release(); }
  kernels::DeviceResult fuse(const kernels::DeviceBatch& b) override {
    if (log_.no_memory) throw kernels::DeviceError("out of memory");
    if (log_.lost) {  // half way
      real_->fuse(b);
      throw kernels::DeviceLost("an illegal address");
    }
    return real_->fuse(b);
  }
  const float* fetch(std::span<const float* const> tiles, std::size_t floats) override {
    if (log_.no_way_back) throw kernels::DeviceError("an illegal address");
    log_.fetched += tiles.size();
    return real_->fetch(tiles, floats);
  }
  void arrived(std::size_t tiles) override { real_->arrived(tiles); }
  const std::uint8_t* costs(const kernels::CostArgs& args, std::span<const float* const> tiles, int planes) override {
    if (log_.no_way_back) throw kernels::DeviceError("an illegal address");
    log_.rendered += tiles.size();
    return real_->costs(args, tiles, planes);
  }
  std::uint64_t combine(int rule, const kernels::DensePlanes& p, std::size_t n) override {
    return real_->combine(rule, p, n);
  }

 private:
  std::unique_ptr<kernels::Device> real_;
  Log& log_;
};

class CellsOnDevice : public OnDevice {
 protected:
  Map watched(const MapParams& params) {
    log = {};
    Map map(params, make_spinning_executor(2));  // which the thread sanitizer sees
    MapAccess::use_device(map, std::make_unique<DeviceMap>(std::make_unique<Watched>(make_device(GetParam()), log)));
    return map;
  }
  Watched::Log log;
};

constexpr CellRect kBox{-100, -150, 260, 300};

template <class T>
std::vector<T> costs_of(const Map& map, CellRect box = kBox, const Costmap& c = {}) {
  std::vector<T> out(static_cast<std::size_t>(box.width * box.height));
  map.render(c, box, std::span<T>(out), box.width);
  return out;
}

TEST_P(CellsOnDevice, StayThereUntilSomeoneReads) {
  const auto d = testing::drive(Model::li2014, 12, 5);
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
    m->integrate(std::span(d->scans).first(5));
    m->integrate(std::span(d->scans).subspan(5, 5));
  }
  EXPECT_EQ(log.fetched, 0U);
  const std::size_t all = map.changes(0).rects.size();
  ASSERT_GT(all, 4U);

  const CellIndex cell = map.cell_at(1, 0.5);
  EXPECT_EQ(map.mass(cell), host.mass(cell));
  EXPECT_NE(map.mass(cell), Mass{});
  EXPECT_EQ(log.fetched, 1U);  // its tile, once

  EXPECT_EQ(costs_of<std::uint8_t>(map), costs_of<std::uint8_t>(host));
  EXPECT_EQ(log.rendered, all - 1);
  EXPECT_EQ(costs_of<std::int8_t>(map), costs_of<std::int8_t>(host));
  EXPECT_EQ(log.rendered, 2 * (all - 1));  // other numbers
  EXPECT_EQ(costs_of<std::uint8_t>(map, {-3, 7, 51, 19}), costs_of<std::uint8_t>(host, {-3, 7, 51, 19}));
  EXPECT_EQ(log.rendered, 2 * (all - 1));  // known
  EXPECT_EQ(log.fetched, 1U);

  // What changes is rendered again, and nothing else.
  const std::uint64_t version = map.version();
  for (Map* m : {&host, &map}) m->integrate(d->scans[10]);
  const std::size_t changed = map.changes(version).rects.size();
  log.rendered = 0;
  EXPECT_EQ(costs_of<std::uint8_t>(map), costs_of<std::uint8_t>(host));
  EXPECT_GE(log.rendered, 1U);
  EXPECT_LE(log.rendered, changed);
  EXPECT_EQ(log.fetched, 1U);

  const MapView view = map.view();
  EXPECT_EQ(view.hash(), host.hash());
  EXPECT_GE(log.fetched, all);
  const std::size_t fetched = log.fetched;
  EXPECT_EQ(map.hash(), host.hash());
  EXPECT_EQ(map.bounds(), host.bounds());
  EXPECT_EQ(log.fetched, fetched);  // nothing is away

  for (Map* m : {&host, &map}) m->integrate(d->scans[11]);
  EXPECT_NE(view.hash(), host.hash());
  EXPECT_EQ(map.hash(), host.hash());
}

/// Whatever looks at cells or changes them, straight after a batch of the device.
TEST_P(CellsOnDevice, AreSeenByWhoeverReadsOrChangesThem) {
  const auto d = testing::drive(Model::hughes1992, 9, 17);
  Map other({.rule = Rule::dempster_log}, make_serial_executor());
  for (const Sensor& s : d->sensors) other.add(s);
  other.integrate(std::span(d->scans).subspan(6));
  const std::vector<Mass> written(64, Mass{0.25f, 0.5f, 0.25f});
  const MapView before = other.view();
  const auto betp = [](const Map& m) {
    std::vector<float> out(static_cast<std::size_t>(kBox.width * kBox.height));
    m.render(Layer::betp, kBox, out, kBox.width);
    return std::string(reinterpret_cast<const char*>(out.data()), out.size() * sizeof(float));
  };
  const auto number = [](auto v) { return std::to_string(v); };
  struct Reader {
    const char* name;
    std::function<std::string(Map&)> read;
  };
  const CellIndex at{20, 10};
  const Reader readers[] = {
      {"mass", [&](Map& m) { return number(m.mass(at).e) + ' ' + number(m.mass(at).o); }},
      {"conflict", [&](Map& m) { return number(m.conflict(at)); }},
      {"con", [&](Map& m) { return number(m.con(at)); }},
      {"last conflict", [&](Map& m) { return number(m.last_conflict(at)); }},
      {"bounds", [&](Map& m) { return number(m.bounds().width) + ' ' + number(m.bounds().y); }},
      {"layer", betp},
      {"hash", [&](Map& m) { return number(m.hash()); }},
      {"file", [&](Map& m) { return cells_of(m); }},
      {"view", [&](Map& m) { return number(m.view().hash()); }},
      {"clear",
       [&](Map& m) {
         return m.clear({0, 0, 37, 21}), cells_of(m);
       }},
      {"write",
       [&](Map& m) {
         return m.write({3, 60, 8, 8}, written, 8), cells_of(m);
       }},
      {"window",
       [&](Map& m) {
         return m.set_window({0, 0, 64, 64}), cells_of(m);
       }},
      {"undo", [&](Map& m) { return m.undo(d->scans[1]), cells_of(m); }},
      {"merge into", [&](Map& m) { return merge(m, before), cells_of(m); }},
      {"merge from",
       [&](Map& m) {
         Map into({.rule = Rule::dempster_log}, make_serial_executor());
         merge(into, m.view());
         return cells_of(into);
       }},
      {"protect",
       [&](Map& m) {
         m.protect({5, -10, 40, 60});
         m.integrate(std::span(d->scans).subspan(6));
         return cells_of(m);
       }},
      {"move",
       [&](Map& m) {
         const Map moved = std::move(m);
         return cells_of(moved);
       }},
  };
  for (const Reader& reader : readers) {
    SCOPED_TRACE(reader.name);
    const MapParams params{.rule = Rule::dempster_log, .keep_con = true, .keep_last_conflict = true};
    Map host(params, make_serial_executor()), map = watched(params);
    for (Map* m : {&host, &map}) {
      for (const Sensor& s : d->sensors) m->add(s);
      m->integrate(std::span(d->scans).first(3));
      m->integrate(std::span(d->scans).subspan(3, 3));
    }
    EXPECT_EQ(log.fetched, 0U);
    EXPECT_TRUE(reader.read(map) == reader.read(host));
    EXPECT_GT(log.fetched, 0U);
  }
}

/// Rules and maps whose costs only the host makes, and those that a device can.
TEST_P(CellsOnDevice, CostsAreTheMapsOwn) {
  const auto d = testing::drive(Model::li2014, 8, 23);
  const Costmap strict{.free_below = 0.3, .lethal_above = 0.30001, .max_unknown = 0.5};
  for (const Rule rule :
       {Rule::pcr5, Rule::dempster, Rule::conjunctive, Rule::bayes, Rule::dempster_log, Rule::fuzzy}) {
    for (const double decay_s : {0.0, 1.5}) {
      const MapParams params{.rule = rule, .decay_s = decay_s};
      if (!check(params).empty()) continue;
      SCOPED_TRACE(std::string(name(rule)) + ' ' + std::to_string(decay_s));
      Map host(params, make_serial_executor()), map = watched(params);
      for (Map* m : {&host, &map}) {
        for (const Sensor& s : d->sensors) m->add(s);
        m->integrate(std::span(d->scans).first(4));
      }
      for (const Costmap& c : {Costmap{}, strict}) {
        EXPECT_EQ(costs_of<std::uint8_t>(map, kBox, c), costs_of<std::uint8_t>(host, kBox, c));
        EXPECT_EQ(costs_of<std::int8_t>(map, kBox, c), costs_of<std::int8_t>(host, kBox, c));
      }
      for (Map* m : {&host, &map}) m->integrate(std::span(d->scans).subspan(4));
      EXPECT_EQ(costs_of<std::uint8_t>(map), costs_of<std::uint8_t>(host));
      EXPECT_EQ(map.hash(), host.hash());
    }
  }
}

/// Costs that were rendered are forgotten with the cells they were of, also where no later batch comes.
TEST_P(CellsOnDevice, CostsFollowWhatTheHostWrites) {
  const auto d = testing::drive(Model::li2014, 8, 29);
  Scan far = d->scans[0];
  far.T_map_robot = {20, 20, 0.5};
  const CellRect there{300, 300, 200, 200};
  const std::vector<Mass> wall(400, Mass{0, 1, 0});
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
    m->integrate(far);
    const auto before = costs_of<std::uint8_t>(*m, there);
    m->write({400, 400, 20, 20}, wall, 20);
    m->clear({380, 380, 20, 20});
    EXPECT_NE(costs_of<std::uint8_t>(*m, there), before);
    m->integrate(d->scans[4]);
  }
  EXPECT_TRUE(costs_of<std::uint8_t>(map, there) == costs_of<std::uint8_t>(host, there));
  EXPECT_TRUE(costs_of<std::uint8_t>(map) == costs_of<std::uint8_t>(host));
  for (Map* m : {&host, &map}) m->integrate(std::span(d->scans).subspan(5));
  EXPECT_TRUE(costs_of<std::uint8_t>(map) == costs_of<std::uint8_t>(host));
  EXPECT_EQ(map.hash(), host.hash());
}

/// A tile that the window left and that is made again is not the one that was away.
TEST_P(CellsOnDevice, AWindowDropsThemWhereTheyAre) {
  const auto d = testing::drive(Model::li2014, 9, 37);
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
    m->integrate(std::span(d->scans).first(3));
    m->set_window({0, 0, 64, 64});
    m->set_window({});
    if (m == &map) {
      EXPECT_EQ(log.fetched, 0U);
    }
    m->integrate(std::span(d->scans).subspan(3, 3));
  }
  EXPECT_EQ(map.tiles(), host.tiles());
  EXPECT_TRUE(cells_of(map) == cells_of(host));
  for (Map* m : {&host, &map}) {
    m->integrate(std::span(d->scans).subspan(6));
    m->clear();
    m->integrate(std::span(d->scans).first(2));
  }
  EXPECT_TRUE(cells_of(map) == cells_of(host));
}

/// A reader of single cells between all batches: the list of what is away does not grow with them.
TEST_P(CellsOnDevice, ComeHomeOneByOneForAsLongAsOneLikes) {
  const auto d = testing::drive(Model::hughes1992, 6, 59);
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
  }
  std::vector<Mass> seen[2];
  for (int round = 0; round < 60; ++round) {
    for (Map* m : {&host, &map}) {
      m->integrate(d->scans[static_cast<std::size_t>(round % 6)]);
      for (int tile = -1; tile <= 1; ++tile) seen[m == &map].push_back(m->mass({tile * 64 + 9, round % 50}));
    }
  }
  EXPECT_EQ(seen[1], seen[0]);
  EXPECT_LE(log.fetched, 180U);
  const std::size_t before = log.fetched;
  EXPECT_EQ(map.hash(), host.hash());
  EXPECT_LE(log.fetched - before, map.tiles());  // none twice
}

TEST_P(CellsOnDevice, ReadersMayComeTogether) {
  const auto d = testing::drive(Model::li2014, 8, 41);
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
    m->integrate(d->scans);
  }
  const auto costs = costs_of<std::uint8_t>(host);
  const std::uint64_t hash = host.hash();
  std::vector<std::thread> readers;
  std::atomic<int> wrong = 0;
  for (int i = 0; i < 6; ++i) {
    readers.emplace_back([&, i] {
      for (int round = 0; round < 5; ++round) {
        const CellIndex at{5 * i + 20 * round, 10 - 17 * i};
        if (map.mass(at) != host.mass(at) || costs_of<std::uint8_t>(map) != costs) ++wrong;
        if (i == 5 && map.hash() != hash) ++wrong;
      }
    });
  }
  for (std::thread& t : readers) t.join();
  EXPECT_EQ(wrong, 0);
}

TEST_P(CellsOnDevice, ComeBackWhenTheDeviceRunsOutOfMemory) {
  const auto d = testing::drive(Model::li2014, 9, 43);
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
    m->integrate(std::span(d->scans).first(6));
  }
  log.no_memory = true;
  for (Map* m : {&host, &map}) m->integrate(std::span(d->scans).subspan(6));
  EXPECT_NE(map.kernel_note().find("out of memory"), std::string_view::npos);
  EXPECT_NE(map.kernel_name(), "cuda");
  EXPECT_EQ(map.hash(), host.hash());
}

/// No memory for a batch, nor for the way back: nothing is fused, and when there is memory again nothing was lost.
TEST_P(CellsOnDevice, WaitForMemoryWhereTheyAre) {
  const auto d = testing::drive(Model::li2014, 9, 53);
  Map host({}, make_serial_executor()), map = watched({});
  for (Map* m : {&host, &map}) {
    for (const Sensor& s : d->sensors) m->add(s);
    m->integrate(std::span(d->scans).first(3));
  }
  log.no_memory = log.no_way_back = true;
  EXPECT_THROW(map.integrate(std::span(d->scans).subspan(3, 3)), std::runtime_error);
  EXPECT_THROW((void)map.hash(), std::runtime_error);
  log.no_memory = log.no_way_back = false;
  for (Map* m : {&host, &map}) m->integrate(std::span(d->scans).subspan(6));
  EXPECT_EQ(map.kernel_name(), "cuda");
  EXPECT_EQ(map.hash(), host.hash());
}

TEST_P(CellsOnDevice, AreMissedWhenTheDeviceIsLost) {
  const auto d = testing::drive(Model::li2014, 9, 47);
  const auto expect_not_whole = [](const std::function<void()>& f) {
    try {
      f();
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& lost) {
      EXPECT_NE(std::string(lost.what()).find("not whole"), std::string::npos) << lost.what();
    }
  };
  {  // nothing was there alone: the processor fuses the batch
    Map host({}, make_serial_executor()), map = watched({});
    for (Map* m : {&host, &map}) {
      for (const Sensor& s : d->sensors) m->add(s);
      m->integrate(std::span(d->scans).first(3));
    }
    (void)map.hash();
    log.lost = true;
    for (Map* m : {&host, &map}) m->integrate(std::span(d->scans).subspan(3));
    EXPECT_EQ(map.hash(), host.hash());
    EXPECT_NE(map.kernel_name(), "cuda");
  }
  Map map = watched({});
  for (const Sensor& s : d->sensors) map.add(s);
  map.integrate(std::span(d->scans).first(3));
  log.lost = true;
  expect_not_whole([&] { map.integrate(d->scans[3]); });
  log.no_way_back = true;
  expect_not_whole([&] { (void)map.mass({20, 10}); });
  expect_not_whole([&] { (void)costs_of<std::uint8_t>(map); });
  expect_not_whole([&] { (void)map.hash(); });
  expect_not_whole([&] { (void)map.view(); });
  expect_not_whole([&] { (void)cells_of(map); });
  expect_not_whole([&] { map.clear({0, 0, 9, 9}); });
  EXPECT_EQ(map.mass({100'000, 100'000}), Mass{});  // no tile, nothing to be missed
  // Also when the device answers again: what it holds is not the map.
  log.lost = log.no_way_back = false;
  expect_not_whole([&] { (void)map.mass({20, 10}); });
  expect_not_whole([&] { (void)costs_of<std::uint8_t>(map); });
  expect_not_whole([&] { map.integrate(d->scans[3]); });
  map.clear();
  map.integrate(d->scans[3]);
  Map host({}, make_serial_executor());
  for (const Sensor& s : d->sensors) host.add(s);
  host.integrate(d->scans[3]);
  EXPECT_EQ(map.hash(), host.hash());
}

INSTANTIATE_TEST_SUITE_P(Devices, CellsOnDevice, ::testing::Values("emulated", "cuda"), device_name);

}  // namespace
}  // namespace evigrid
