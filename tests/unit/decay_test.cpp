// SPDX-License-Identifier: Apache-2.0
// Forgetting by time: what a cell keeps, when it is read, and that reading leaves no trace. The masses against the
// formula here, whole maps against the slow reference in tests/oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "equivalence/random_scans.hpp"
#include "evigrid/view.hpp"

namespace evigrid {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr CellIndex kAhead{10, 0};  // in the empty part of heard()'s cone

Sensor sonar() {
  Sensor s;
  s.model = Model::hughes1992;
  s.reliability = 0.9;
  return s;
}
/// A map that one sonar told of 2 m ahead at `stamp_ns`.
Map heard(const MapParams& params, std::int64_t stamp_ns, const Sensor& sensor = sonar()) {
  Map map(params, make_serial_executor());
  const SensorId id = map.add(sensor);
  const float range_m = 2;
  const Reading reading{id, {&range_m, 1}};
  map.integrate({.stamp_ns = stamp_ns, .T_map_robot = {0.025, 0.025, 0}, .readings = {&reading, 1}});
  return map;
}
void hear_again(Map& map, std::int64_t stamp_ns) {
  const float range_m = 2;
  const Reading reading{0, {&range_m, 1}};
  map.integrate({.stamp_ns = stamp_ns, .T_map_robot = {0.025, 0.025, 0}, .readings = {&reading, 1}});
}

TEST(Decay, KeepsAnExponentialShareAndGivesTheRestToTheUnknown) {
  for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::yager, Rule::conjunctive}) {
    Map map = heard({.rule = rule, .decay_s = 20}, 5 * kSecond);
    const Mass before = map.mass(kAhead);
    ASSERT_GT(before.e, 0.3F);
    for (const double later_s : {0.0, 0.001, 1.0, 20.0, 200.0}) {
      map.advance_to(static_cast<std::int64_t>((5 + later_s) * 1e9));
      const Mass now = map.mass(kAhead);
      const double share = std::exp(-later_s / 20);
      EXPECT_NEAR(now.e, share * before.e, 1e-7) << later_s;
      EXPECT_NEAR(now.u, 1 - share * (1 - static_cast<double>(before.u)), 2e-7) << later_s;
      EXPECT_NEAR(static_cast<double>(now.e) + now.o + now.u + now.c, 1, 2e-7);
    }
  }
}

TEST(Decay, ForgetsEverythingInTheEnd) {
  Map map = heard({.decay_s = 1}, 0);
  EXPECT_FALSE(map.bounds().empty());
  map.advance_to(40 * kSecond);  // e^-40 is below what a map takes for 0
  EXPECT_TRUE(map.bounds().empty());
  EXPECT_EQ(map.mass(kAhead), Mass{});
  map.advance_to(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(map.mass(kAhead), Mass{});
  EXPECT_EQ(map.hash(), Map(MapParams{.decay_s = 1}).hash());
}

TEST(Decay, SeveralStepsOfTimeAreOne) {  // the stamp stays that of the reading
  Map once = heard({.decay_s = 7}, 0), often = heard({.decay_s = 7}, 0);
  once.advance_to(9 * kSecond);
  for (int i = 1; i <= 9; ++i) {
    often.advance_to(i * kSecond);
    (void)often.hash();
    (void)often.mass(kAhead);
  }
  EXPECT_EQ(often.hash(), once.hash());
}

TEST(Decay, ReadingNeverWritesBack) {
  Map read = heard({.decay_s = 3}, 0), left_alone = heard({.decay_s = 3}, 0);
  const std::uint64_t at_first = read.hash();
  read.advance_to(kSecond);
  std::vector<float> out(64 * 64);
  read.render(Layer::betp, {0, -32, 64, 64}, out, 64);
  EXPECT_NE(read.hash(), at_first);
  for (Map* map : {&read, &left_alone}) hear_again(*map, 2 * kSecond);
  EXPECT_EQ(read.hash(), left_alone.hash());
}

TEST(Decay, AllWaysOfReadingAgree) {
  const auto d = testing::drive(Model::li2014, 12, 3);
  for (std::size_t i = 0; i < d->scans.size(); ++i) d->scans[i].stamp_ns = static_cast<std::int64_t>(i) * 300'000;
  for (const Rule rule : {Rule::pcr5, Rule::conjunctive}) {
    Map map({.rule = rule, .keep_con = true, .decay_s = 1e-3}, make_serial_executor());
    for (const Sensor& s : d->sensors) map.add(s);
    map.integrate(d->scans);
    const CellRect box = map.bounds();
    std::vector<float> empty(static_cast<std::size_t>(box.width * box.height));
    std::vector<std::int8_t> costs(empty.size());
    map.render(Layer::empty, box, empty, box.width);
    map.render(Costmap{}, box, costs, box.width);
    for (std::int64_t y = 0; y < box.height; ++y) {
      for (std::int64_t x = 0; x < box.width; ++x) {
        const Mass m = map.mass({box.x + x, box.y + y});
        const auto i = static_cast<std::size_t>(y * box.width + x);
        ASSERT_EQ(empty[i], m.e);
        ASSERT_EQ(costs[i], occupancy_of(Costmap{}, m));
      }
    }
  }
}

TEST(Decay, TimeThatRunsBackwardsBringsNothingBack) {
  Map map = heard({.decay_s = 2}, 10 * kSecond);
  map.advance_to(12 * kSecond);
  const std::uint64_t then = map.hash();
  map.advance_to(kSecond);
  EXPECT_EQ(map.hash(), then);
  const Mass before = map.mass(kAhead);
  hear_again(map, 9 * kSecond);  // late: nothing is aged for it, and its cells keep the later stamp
  EXPECT_GT(map.mass(kAhead).e, before.e);
  Map in_order = heard({.decay_s = 2}, 10 * kSecond);
  hear_again(in_order, 10 * kSecond);
  in_order.advance_to(12 * kSecond);
  EXPECT_EQ(map.hash(), in_order.hash());
}

TEST(Decay, AViewKeepsItsTime) {
  Map map = heard({.decay_s = 2}, 0);
  const MapView view = map.view();
  const std::uint64_t then = map.hash();
  map.advance_to(kSecond);
  EXPECT_EQ(view.hash(), then);
  EXPECT_NE(map.hash(), then);
  EXPECT_EQ(map.view().hash(), map.hash());
  hear_again(map, 2 * kSecond);
  EXPECT_EQ(view.hash(), then);
}

TEST(Decay, ASensorMayHaveATimeOfItsOwn) {
  Sensor slow = sonar();
  slow.decay_s = 1000;
  Map map = heard({.decay_s = 2}, 0, slow);
  const float before = map.mass(kAhead).e;
  map.advance_to(10 * kSecond);
  EXPECT_NEAR(map.mass(kAhead).e, before * std::exp(-10.0 / 1000), 1e-7);
}

TEST(Decay, SameBitsForEveryKernelExecutorAndBatch) {
  for (const Model model : {Model::li2014, Model::hughes1992}) {
    auto d = testing::drive(model, 16, 17);
    for (std::size_t i = 0; i < d->scans.size(); ++i)
      d->scans[i].stamp_ns = static_cast<std::int64_t>(i) * kSecond / 10;
    for (std::size_t i = 0; i < d->sensors.size(); i += 3) d->sensors[i].decay_s = 0.5;
    for (const Rule rule : {Rule::dempster, Rule::pcr5, Rule::germ_pcr2, Rule::conjunctive}) {
      MapParams params{.rule = rule, .keep_con = true, .keep_last_conflict = true, .decay_s = 3};
      const auto first = testing::fuse(*d, params, make_serial_executor());
      for (const Kernel kernel : {Kernel::scalar, Kernel::avx2, Kernel::avx512}) {
        if (!kernel_available(kernel)) continue;
        params.kernel = kernel;
        for (const std::size_t batch : {1U, 40U}) {
          const auto other = testing::fuse(*d, params, make_tbb_executor(2), batch);
          EXPECT_EQ(other.hash, first.hash) << name(rule) << ' ' << name(kernel) << ' ' << batch;
          EXPECT_EQ(other.report.cells_updated, first.report.cells_updated);
        }
      }
    }
  }
}

TEST(Decay, ASavedMapGoesOnForgetting) {
  const auto d = testing::drive(Model::li2014, 30, 8);
  for (std::size_t i = 0; i < d->scans.size(); ++i)
    d->scans[i].stamp_ns = -kSecond + static_cast<std::int64_t>(i) * kSecond;
  Map map({.decay_s = 5}, make_serial_executor());
  for (const Sensor& s : d->sensors) map.add(s);
  map.integrate(std::span(d->scans).first(20));
  std::ostringstream out;
  save(map, out);
  const std::string bytes = out.str();
  Map loaded = load(std::as_bytes(std::span(bytes)));
  EXPECT_EQ(loaded.params().decay_s, 5);
  EXPECT_EQ(loaded.hash(), map.hash());
  for (Map* m : {&map, &loaded}) m->integrate(std::span(d->scans).subspan(20));
  EXPECT_EQ(loaded.hash(), map.hash());
}

TEST(Decay, WithoutItTimeDoesNothing) {
  Map map = heard({}, 0);
  const std::uint64_t before = map.hash();
  map.advance_to(1000 * kSecond);
  hear_again(map, 5);
  EXPECT_NE(map.hash(), before);
  EXPECT_EQ(map.memory_bytes() % (64 * 64 * 4 * 4), 0U);  // four planes a cell, none of age
}

TEST(Decay, BadOnesAreRefusedByName) {
  for (const double bad : {-1.0, 1e-4, 1e10, static_cast<double>(NAN)}) {
    const auto errors = check(MapParams{.decay_s = bad});
    ASSERT_EQ(errors.size(), 1U) << bad;
    EXPECT_EQ(errors[0].field, "map.decay_s");
  }
  for (const Rule rule : {Rule::bayes, Rule::fuzzy, Rule::murphy, Rule::cautious, Rule::dempster_log}) {
    const auto errors = check(MapParams{.rule = rule, .decay_s = 1});
    ASSERT_EQ(errors.size(), 1U) << name(rule);
    EXPECT_EQ(errors[0].field, "map.decay_s");
  }
  Sensor s = sonar();
  s.decay_s = -2;
  ASSERT_EQ(check(s).size(), 1U);
  EXPECT_EQ(check(s)[0].field, "sensor.decay_s");
}

}  // namespace
}  // namespace evigrid
