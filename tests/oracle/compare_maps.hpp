// SPDX-License-Identifier: Apache-2.0
// The engine's map and the slow reference side by side: both get the same sensors and scans, then every cell's
// membership, masses and conflict, and every counter of the report, are compared.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include "tests/oracle/reference_map.hpp"

namespace oracle {

inline constexpr double kMassBound = 2e-6;  ///< per mass; for the running conflict, and where c is one: per update

/// A weight is a mass over v: where li2014 says v = 1e-4 and is off by 7e-9 the weight is off by 7e-5 of itself. Sums
/// of logarithms see that as 7e-5 of their hundreds; the larger of two weights shows all of it.
inline double mass_bound(evigrid::Rule rule, const evigrid::Sensor& s) {
  if (rule != evigrid::Rule::cautious || s.reliability != 1) return kMassBound;
  // li2006: v = (θ/α)² near the axis, from the difference of two floats that are a hundred times θ/α = 0.01 where v is
  // 1e-4: each off by 6e-8 makes 1.2e-5 of v, and o/(e + o) of two such weights moves by half of that.
  if (s.model == evigrid::Model::li2006) return 6e-6;
  return s.model == evigrid::Model::li2014 ? 1e-4 : kMassBound;
}

struct Difference {
  double mass = 0, conflict_per_update = 0;
  std::uint64_t membership = 0;  ///< cells that only one of the two maps holds
  std::uint64_t cells = 0, most_updates = 0;
  std::string at;
  void merge(const Difference& d) {
    if (d.mass > mass || at.empty()) at = d.at;
    mass = std::max(mass, d.mass);
    conflict_per_update = std::max(conflict_per_update, d.conflict_per_update);
    membership += d.membership, cells += d.cells;
    most_updates = std::max(most_updates, d.most_updates);
  }
};

class Both {
 public:
  explicit Both(const evigrid::MapParams& params)
      : engine_(params, std::shared_ptr<evigrid::Executor>(evigrid::make_serial_executor())), reference_(params) {}
  evigrid::SensorId add(const evigrid::Sensor& s) {
    reference_.add(s);
    return engine_.add(s);
  }
  void integrate(const evigrid::Scan& scan) {
    report_ += engine_.integrate(scan);
    reference_.integrate(scan);
  }
  /// One range of one sensor.
  void integrate(const evigrid::Pose2& pose, evigrid::SensorId id, std::span<const float> ranges_m) {
    const evigrid::Reading reading{id, ranges_m};
    integrate(evigrid::Scan{stamp_ns_++, pose, {&reading, 1}});
  }
  [[nodiscard]] const evigrid::Map& engine() const { return engine_; }
  [[nodiscard]] const ReferenceMap& reference() const { return reference_; }
  [[nodiscard]] const evigrid::Report& report() const { return report_; }

  [[nodiscard]] Difference difference() const {
    Difference d;
    d.cells = reference_.cells().size();
    std::uint64_t in_both = 0;
    for (const auto& [index, cell] : reference_.cells()) {
      const ReferenceCell want = reference_.now(cell);
      const evigrid::Mass got = engine_.mass(index);
      const bool held = got.e != 0 || got.o != 0 || got.c != 0;
      d.most_updates = std::max(d.most_updates, want.updates);
      if (held == want.vacuous()) ++d.membership, d.at = describe(index, got, want);
      in_both += held;
      double mass = std::max(
          {std::fabs(got.e - want.e), std::fabs(got.o - want.o), std::fabs(got.u - want.u), std::fabs(got.c - want.c)});
      if (!(mass <= 2)) mass = 2;
      if (const auto rule = engine_.params().rule; rule == evigrid::Rule::conjunctive || rule == evigrid::Rule::dsmc)
        mass /= static_cast<double>(std::max<std::uint64_t>(1, want.updates));
      if (mass > d.mass || d.at.empty()) d.mass = mass, d.at = describe(index, got, want);
      const double conflict = std::fabs(engine_.conflict(index) - want.conflict);
      d.conflict_per_update =
          std::max(d.conflict_per_update, conflict / static_cast<double>(std::max<std::uint64_t>(1, want.updates)));
    }
    const evigrid::CellRect box = engine_.bounds();
    std::uint64_t held = 0;
    for (std::int64_t y = box.y; y < box.y + box.height; ++y)
      for (std::int64_t x = box.x; x < box.x + box.width; ++x) {
        const evigrid::Mass m = engine_.mass({x, y});
        held += m.e != 0 || m.o != 0 || m.c != 0;
      }
    d.membership += held - in_both;  // cells of the engine that the reference never touched
    return d;
  }

  void expect_equal_reports() const {
    const ReferenceReport& want = reference_.report();
    EXPECT_EQ(report_.readings_used, want.readings_used);
    EXPECT_EQ(report_.readings_clipped, want.readings_clipped);
    EXPECT_EQ(report_.cells_updated, want.cells_updated);
    EXPECT_EQ(report_.total_conflicts, want.total_conflicts);
    EXPECT_EQ(report_.stamps_backwards, want.stamps_backwards);
    EXPECT_NEAR(report_.max_conflict, want.max_conflict, kMassBound);
    for (int i = 0; i < evigrid::kRefusalCount; ++i)
      EXPECT_EQ(report_.refused[i], want.refused[i]) << name(static_cast<evigrid::Refusal>(i));
  }

 private:
  static std::string describe(evigrid::CellIndex c, evigrid::Mass m, const ReferenceCell& r) {
    char text[256];
    std::snprintf(text, sizeof text, "cell (%lld, %lld): engine %.9g %.9g %.9g, reference %.9g %.9g %.9g, %llu updates",
                  static_cast<long long>(c.x), static_cast<long long>(c.y), static_cast<double>(m.e),
                  static_cast<double>(m.o), static_cast<double>(m.u), r.e, r.o, r.u,
                  static_cast<unsigned long long>(r.updates));
    return text;
  }
  evigrid::Map engine_;
  ReferenceMap reference_;
  evigrid::Report report_;
  std::int64_t stamp_ns_ = 0;
};

/// @param mass_bound kMassBound, unless a rule is known to need more (reference_scene_test.cpp).
inline void expect_within_bounds(const Difference& d, double mass_bound = kMassBound) {
  EXPECT_EQ(d.membership, 0U) << d.at;
  EXPECT_LE(d.mass, mass_bound) << d.at;
  EXPECT_LE(d.conflict_per_update, std::max(mass_bound / 10, kMassBound));
}

inline void print(const std::string& what, const Difference& d) {
  char number[32];
  std::snprintf(number, sizeof number, "%.3g", d.mass);
  std::cout << "largest error " << what << ": mass " << number << ", conflict per update " << d.conflict_per_update
            << "; membership " << d.membership << " wrong of " << d.cells << " cells, at most " << d.most_updates
            << " updates; " << d.at << '\n';
  std::string key = what;
  std::replace_if(
      key.begin(), key.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  testing::Test::RecordProperty(key, number);
}

/// A single reading into fresh maps.
inline Difference once(const evigrid::MapParams& params, const evigrid::Sensor& sensor, const evigrid::Pose2& pose,
                       std::span<const float> ranges_m) {
  Both both(params);
  both.integrate(pose, both.add(sensor), ranges_m);
  both.expect_equal_reports();
  return both.difference();
}

}  // namespace oracle
