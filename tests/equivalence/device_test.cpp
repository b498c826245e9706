// SPDX-License-Identifier: Apache-2.0
// A device's map is the map, bit for bit: every rule, model and plane, views, erased and loaded tiles. Run on the
// emulated device everywhere, and on the CUDA one where there is a GPU.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <sstream>

#include "device/device_combine.hpp"
#include "device/device_map.hpp"
#include "equivalence/random_scans.hpp"
#include "evigrid/io.hpp"
#include "evigrid/view.hpp"
#include "io/map_access.hpp"

namespace evigrid {
namespace {

using testing::Drive;

std::unique_ptr<kernels::Device> make_device(const std::string& kind) {
  return kind == "cuda" ? kernels::make_cuda_device() : kernels::make_emulated_device();
}

class OnDevice : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "cuda" && !kernels::why_no_cuda().empty()) GTEST_SKIP() << kernels::why_no_cuda();
  }
  Map on_device(const MapParams& params, std::shared_ptr<Executor> executor = make_serial_executor()) {
    Map map(params, std::move(executor));
    MapAccess::use_device(map, std::make_unique<DeviceMap>(make_device(GetParam())));
    return map;
  }
};

void feed(Map& map, const Drive& d, std::size_t batch, Report* report = nullptr) {
  for (std::size_t i = 0; i < d.scans.size(); i += batch) {
    const Report r = map.integrate(std::span(d.scans).subspan(i, std::min(batch, d.scans.size() - i)));
    if (report != nullptr) *report += r;
  }
}
/// All bytes of the cells, the planes of history among them.
std::string cells_of(const Map& map) {
  std::ostringstream out;
  save(map, out);
  const std::string bytes = out.str();
  return bytes.substr(bytes.find("\x28\xB5\x2F\xFD"));
}

TEST_P(OnDevice, EveryRuleAndModelGivesTheSameBits) {
  for (const Model model : all_models()) {
    const auto d = testing::drive(model == Model::beam ? Model::hughes1992 : model, 6, 77);
    for (const Rule rule : map_rules()) {
      if (!why_not_together(rule, model).empty() || same_as(rule) != rule) continue;
      SCOPED_TRACE(std::string(name(rule)) + " " + std::string(name(model)));
      const bool fits = why_not_together(rule, Model::beam).empty();
      for (const bool keep : {true, false}) {
        const MapParams params{.rule = rule, .keep_conflict = keep, .keep_con = keep, .keep_last_conflict = keep};
        Map host(params, make_serial_executor()), device = on_device(params);
        for (Map* map : {&host, &device}) {
          for (const Sensor& s : d->sensors) {
            if (s.model != Model::beam || fits) map->add(s);
          }
        }
        Report on_host, there;
        feed(host, *d, 4, &on_host);
        feed(device, *d, 4, &there);
        EXPECT_EQ(device.hash(), host.hash());
        EXPECT_TRUE(cells_of(device) == cells_of(host));
        EXPECT_EQ(there.cells_updated, on_host.cells_updated);
        EXPECT_EQ(there.total_conflicts, on_host.total_conflicts);
        EXPECT_EQ(there.max_conflict, on_host.max_conflict);
        EXPECT_EQ(there.refused_total(), on_host.refused_total());
      }
    }
  }
}

TEST_P(OnDevice, ContextualReliabilityAndBatchesOfAnySize) {
  auto d = testing::drive(Model::li2014, 12, 5);
  for (Sensor& s : d->sensors) s.reliability_if_empty = 0.8, s.reliability_if_occupied = 0.7;
  const MapParams params{.rule = Rule::pcr5};
  const auto want = testing::fuse(*d, params, make_serial_executor());
  for (const std::size_t batch : {1U, 5U, 12U}) {
    Map map = on_device(params, make_tbb_executor(2));
    for (const Sensor& s : d->sensors) map.add(s);
    feed(map, *d, batch);
    EXPECT_EQ(map.hash(), want.hash) << batch;
    EXPECT_EQ(map.kernel_name(), "cuda");
    EXPECT_EQ(map.kernel_note(), "");
  }
}

/// Maps that forget: every rule whose cells are masses, with all planes and with those of age alone.
TEST_P(OnDevice, ForgetsAsTheProcessorDoes) {
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
TEST_P(OnDevice, ACellThatIsToldNothingStaysAsOldAsItIs) {
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
TEST_P(OnDevice, FrozenCellsAreRenewed) {
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
TEST_P(OnDevice, ProtectedAreasAreTheMapsOwn) {
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

TEST_P(OnDevice, ViewsClearAndUndoAreTheMapsOwn) {
  const auto d = testing::drive(Model::hughes1992, 12, 6);
  const MapParams params{.rule = Rule::dempster_log, .keep_conflict = false};
  Map host(params, make_serial_executor()), device = on_device(params);
  for (Map* map : {&host, &device}) {
    for (const Sensor& s : d->sensors) map->add(s);
    map->integrate(std::span(d->scans).first(4));
  }
  const MapView view = device.view();
  const std::uint64_t then = host.hash();
  for (Map* map : {&host, &device}) map->integrate(std::span(d->scans).subspan(4));
  EXPECT_EQ(view.hash(), then);
  EXPECT_EQ(device.hash(), host.hash());
  for (Map* map : {&host, &device}) map->undo(std::span(d->scans).first(4));
  EXPECT_EQ(device.hash(), host.hash());
  for (Map* map : {&host, &device}) {
    map->clear();
    map->integrate(std::span(d->scans).first(7));
  }
  EXPECT_EQ(device.hash(), host.hash());
  EXPECT_FALSE(device.changes(0).rects.empty());
}

TEST_P(OnDevice, ChangesCoverWhatChanged) {
  const auto d = testing::drive(Model::li2014, 8, 9);
  Map device = on_device({});
  for (const Sensor& s : d->sensors) device.add(s);
  device.integrate(std::span(d->scans).first(7));
  const std::uint64_t version = device.version();
  const CellRect box = device.bounds();
  const auto draw = [&] {
    std::vector<float> out(static_cast<std::size_t>((box.width + 400) * (box.height + 400)));
    device.render(Layer::betp, {box.x - 200, box.y - 200, box.width + 400, box.height + 400}, out, box.width + 400);
    return out;
  };
  const std::vector<float> before = draw();
  device.integrate(d->scans[7]);
  const std::vector<float> after = draw();
  std::vector<char> said(before.size(), 0);
  for (const CellRect& r : device.changes(version).rects) {
    for (std::int64_t y = r.y; y < r.y + r.height; ++y) {
      for (std::int64_t x = r.x; x < r.x + r.width; ++x) {
        const std::int64_t at = (y - box.y + 200) * (box.width + 400) + x - box.x + 200;
        if (at >= 0 && at < static_cast<std::int64_t>(said.size())) said[static_cast<std::size_t>(at)] = 1;
      }
    }
  }
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) continue;
    ++changed;
    ASSERT_TRUE(said[i]);
  }
  EXPECT_GT(changed, 100U);
}

/// What its kernels do not do, the processor does between two batches of the device, and the map says so.
TEST_P(OnDevice, MapsThatItDoesNotServeAreFusedOnTheProcessor) {
  const auto d = testing::drive(Model::li2014, 9, 11);
  const auto both = [&](Dependence dependence) {
    Map host({}, make_serial_executor()), device = on_device({});
    for (Map* map : {&host, &device}) {
      for (Sensor s : d->sensors) {
        s.dependence = dependence;
        map->add(s);
      }
      for (std::size_t at = 0; at < d->scans.size(); at += 3) {
        map->integrate(std::span(d->scans).subspan(at, 3));
        if (map == &device && at == 3) {
          EXPECT_NE(map->kernel_note().find("processor"), std::string_view::npos);
        }
      }
    }
    EXPECT_EQ(device.hash(), host.hash()) << name(dependence);
  };
  for (const Dependence dependence : {Dependence::once_per_scan, Dependence::cautious, Dependence::weighted})
    both(dependence);
}

TEST_P(OnDevice, DenseCombinationGivesTheSameBits) {
  constexpr std::size_t kPairs = 10'001;
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> u(0, 1);
  std::vector<float> in[6];
  for (auto& plane : in) plane.resize(kPairs);
  for (std::size_t i = 0; i < kPairs; ++i) {
    for (int side = 0; side < 2; ++side) {
      float a = u(rng), b = u(rng);
      if (a > b) std::swap(a, b);
      if (i % 97 == 0) a = side == 0 ? 1.0f : 0.0f, b = 1;  // certain, and in contradiction
      in[3 * side][i] = a, in[3 * side + 1][i] = b - a, in[3 * side + 2][i] = 1 - b;
    }
  }
  const auto device = make_device(GetParam());
  for (const Rule rule : all_rules()) {
    std::vector<float> want[5], got[5];
    for (auto* all : {want, got}) {
      for (int p = 0; p < 5; ++p) all[p].assign(kPairs, -1);
    }
    const Planes<const float> a{in[0].data(), in[1].data(), in[2].data()}, b{in[3].data(), in[4].data(), in[5].data()};
    const auto totals =
        combine(rule, a, b, {want[0].data(), want[1].data(), want[2].data(), want[4].data()}, want[3].data(), kPairs);
    EXPECT_EQ(combine_by_device(*device, rule, a, b, {got[0].data(), got[1].data(), got[2].data(), got[4].data()},
                                got[3].data(), kPairs),
              totals);
    for (int p = 0; p < 5; ++p)
      EXPECT_EQ(std::memcmp(want[p].data(), got[p].data(), kPairs * sizeof(float)), 0) << name(rule) << " plane " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, OnDevice, ::testing::Values("emulated", "cuda"),
                         [](const auto& p) { return p.param; });

/// Fails at the call it is told to.
class Failing final : public kernels::Device {
 public:
  explicit Failing(int good) : left_(good), real_(kernels::make_emulated_device()) {}
  [[nodiscard]] std::string name() const override { return "failing"; }
  float* take(std::size_t bytes) override { return real_->take(bytes); }
  void release() noexcept override { real_->release(); }
  kernels::DeviceResult fuse(const kernels::DeviceBatch& b) override {
    if (left_-- <= 0) throw kernels::DeviceError("CUDA: memory for tiles: out of memory");
    return real_->fuse(b);
  }
  void arrived(std::size_t) override {}
  std::uint64_t combine(int, const kernels::DensePlanes&, std::size_t) override { return 0; }

 private:
  int left_;
  std::unique_ptr<kernels::Device> real_;
};

TEST(DeviceThatFails, LeavesTheMapToTheProcessorAndSaysSo) {
  const auto d = testing::drive(Model::li2014, 12, 5);
  const auto want = testing::fuse(*d, {}, make_serial_executor());
  for (const int good : {0, 2}) {
    Map map({}, make_serial_executor());
    MapAccess::use_device(map, std::make_unique<DeviceMap>(std::make_unique<Failing>(good)));
    for (const Sensor& s : d->sensors) map.add(s);
    feed(map, *d, 4);
    EXPECT_EQ(map.hash(), want.hash);
    EXPECT_NE(map.kernel_name(), "cuda");
    EXPECT_NE(map.kernel_note().find("out of memory"), std::string_view::npos);
  }
}

TEST(NoCuda, IsRefusedByName) {
  if (kernel_available(Kernel::cuda)) GTEST_SKIP() << "there is a device";
  try {
    Map map({.kernel = Kernel::cuda});
    FAIL();
  } catch (const std::invalid_argument& refused) {
    EXPECT_NE(std::string(refused.what()).find("cuda"), std::string::npos);
  }
  EXPECT_FALSE(why_no_cuda().empty());
}

}  // namespace
}  // namespace evigrid
