// SPDX-License-Identifier: Apache-2.0
// A device's map is the map, bit for bit: every rule, model and plane, views, erased and loaded tiles. Run on the
// emulated device everywhere, and on the CUDA one where there is a GPU.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "device/device_combine.hpp"
#include "equivalence/on_device.hpp"
#include "evigrid/view.hpp"

namespace evigrid {
namespace {

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

INSTANTIATE_TEST_SUITE_P(Devices, OnDevice, ::testing::Values("emulated", "cuda"), device_name);

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
  const float* fetch(std::span<const float* const> tiles, std::size_t floats) override {
    return real_->fetch(tiles, floats);
  }
  void arrived(std::size_t tiles) override { real_->arrived(tiles); }
  const std::uint8_t* costs(const kernels::CostArgs& args, std::span<const float* const> tiles, int planes) override {
    return real_->costs(args, tiles, planes);
  }
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
