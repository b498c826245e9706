// SPDX-License-Identifier: Apache-2.0
// Maps that forget and areas that are protected, on a device: bit for bit what they are on the processor.
#include <gtest/gtest.h>

#include "equivalence/on_device.hpp"

namespace evigrid {
namespace {

class LifeOnDevice : public OnDevice {};

/// Maps that forget: every rule whose cells are masses, with all planes and with those of age alone.
TEST_P(LifeOnDevice, ForgetsAsTheProcessorDoes) {
  for (const Model model : {Model::li2014, Model::hughes1992, Model::li2006}) {
    auto d = testing::drive(model, 8, 21);
    for (std::size_t i = 0; i < d->scans.size();
         ++i)  // now and then back in time, and a pause in which all is forgotten
      d->scans[i].stamp_ns = i == 5  ? 700'000'000
                             : i > 6 ? 1'000'000'000'000
                                     : static_cast<std::int64_t>(i) * 300'000'000;
    for (std::size_t i = 0; i < d->sensors.size(); i += 3) d->sensors[i].decay_s = 0.4;
    std::size_t rules = 0;
    for (const Rule rule : map_rules()) {
      if (!why_not_together(rule, model).empty() || same_as(rule) != rule) continue;
      for (const bool keep : {true, false}) {
        const MapParams params{
            .rule = rule, .keep_conflict = keep, .keep_con = keep, .keep_last_conflict = keep, .decay_s = 1.5};
        if (!check(params).empty()) continue;  // its cells hold no masses
        SCOPED_TRACE(std::string(name(rule)) + " " + std::string(name(model)));
        ++rules;
        Map host(params, make_serial_executor()), device = on_device(params), steady({.rule = rule});
        for (Map* map : {&host, &device, &steady}) {
          for (const Sensor& s : d->sensors) map->add(s);
        }
        Report on_host, there;
        feed(host, *d, 3, &on_host);
        feed(device, *d, 3, &there);
        feed(steady, *d, 3);
        EXPECT_EQ(device.kernel_note(), "");
        EXPECT_EQ(device.hash(), host.hash());
        EXPECT_TRUE(cells_of(device) == cells_of(host));
        EXPECT_NE(device.hash(), steady.hash());
        EXPECT_EQ(there.cells_updated, on_host.cells_updated);
        EXPECT_EQ(there.total_conflicts, on_host.total_conflicts);
        EXPECT_EQ(there.max_conflict, on_host.max_conflict);
      }
    }
    EXPECT_GE(rules, 18U);
  }
}

/// An edge of the second cone passes through the centres of cells, whose λ is 0 there: a reading that changes no bit
/// leaves a cell as old as it is.
TEST_P(LifeOnDevice, ACellThatIsToldNothingStaysAsOldAsItIs) {
  const MapParams params{.decay_s = 1.5};
  Map host(params, make_serial_executor()), device = on_device(params);
  for (Map* map : {&host, &device}) {
    Sensor wide, narrow;
    wide.model = narrow.model = Model::li2006;
    wide.aperture_rad = 0.7;
    narrow.aperture_rad = 0.4;
    narrow.T_robot_sensor.yaw_rad = -0.2;
    const SensorId ids[] = {map->add(wide), map->add(narrow)};
    const float range = 2;
    const Reading readings[] = {{ids[0], {&range, 1}}, {ids[1], {&range, 1}}};
    const Pose2 pose{0.025, 0.025, 0};
    map->integrate(Scan{0, pose, {readings, 1}});
    map->integrate(Scan{1'000'000'000, pose, {readings + 1, 1}});
    const Mass on_edge = map->mass(map->cell_at(1.025, 0.025)), inside = map->mass(map->cell_at(1.025, -0.125));
    EXPECT_LT(on_edge.e, 0.75f * inside.e);  // which was told twice
  }
  EXPECT_TRUE(cells_of(device) == cells_of(host));
}

/// Protection freezes the cells of maps that forget, without a reading: a device must not go on with what it had.
TEST_P(LifeOnDevice, FrozenCellsAreRenewed) {
  const auto d = testing::drive(Model::hughes1992, 9, 31);
  for (std::size_t i = 0; i < d->scans.size(); ++i) d->scans[i].stamp_ns = static_cast<std::int64_t>(i) * 400'000'000;
  const MapParams params{.decay_s = 1.5};
  Map host(params, make_serial_executor()), device = on_device(params), open = on_device(params);
  for (Map* map : {&host, &device, &open}) {
    for (const Sensor& s : d->sensors) map->add(s);
    for (std::size_t at = 0; at < d->scans.size(); at += 3) {
      if (map != &open && at == 3) map->protect({0, 0, 64, 64});  // a whole tile: no batch reaches it
      if (map != &open && at == 6) map->unprotect();
      map->integrate(std::span(d->scans).subspan(at, 3));
    }
  }
  EXPECT_TRUE(cells_of(device) == cells_of(host));
  EXPECT_FALSE(cells_of(device) == cells_of(open));
}

/// Protected cells keep their bits, and what a device knows of their tiles is renewed.
TEST_P(LifeOnDevice, ProtectedAreasAreTheMapsOwn) {
  const auto d = testing::drive(Model::li2014, 9, 11);
  Map host({}, make_serial_executor()), device = on_device({});
  for (Map* map : {&host, &device}) {
    for (const Sensor& s : d->sensors) map->add(s);
    for (std::size_t at = 0; at < d->scans.size(); at += 3) {
      if (at == 3) map->protect({5, -10, 40, 60});
      if (at == 6) map->unprotect();
      map->integrate(std::span(d->scans).subspan(at, 3));
      EXPECT_EQ(map->kernel_note(), "");
    }
  }
  EXPECT_EQ(device.hash(), host.hash());
  Map open = on_device({});
  for (const Sensor& s : d->sensors) open.add(s);
  feed(open, *d, 3);
  EXPECT_NE(device.hash(), open.hash());
}

INSTANTIATE_TEST_SUITE_P(Devices, LifeOnDevice, ::testing::Values("emulated", "cuda"), device_name);

}  // namespace
}  // namespace evigrid
