// SPDX-License-Identifier: Apache-2.0
// Bad parameters are listed by name and reason, all at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "evigrid/evigrid.hpp"

namespace evigrid {
namespace {

bool names(const std::vector<ParamError>& errors, const std::string& field) {
  for (const auto& e : errors) {
    if (e.field == field && !e.reason.empty()) return true;
  }
  return false;
}

TEST(Params, DefaultsAreValid) {
  EXPECT_TRUE(check(MapParams{}).empty());
  EXPECT_TRUE(check(Sensor{}).empty());
  Sensor h;
  h.model = Model::hughes1992;
  EXPECT_TRUE(check(h).empty());
}

TEST(Params, EveryBadFieldIsNamed) {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(names(check(MapParams{.cell_m = bad}), "map.cell_m")) << bad;
  }
  Sensor s;
  s.aperture_rad = 2;
  s.reliability = 0;
  s.li.rho_e = -1;
  s.beams = 3;
  const auto errors = check(s);
  EXPECT_TRUE(names(errors, "sensor.aperture_rad"));
  EXPECT_TRUE(names(errors, "sensor.reliability"));
  EXPECT_TRUE(names(errors, "sensor.li.rho_e"));
  EXPECT_TRUE(names(errors, "sensor.beams"));
  Sensor swapped;
  swapped.min_range_m = 6;
  EXPECT_TRUE(names(check(swapped), "sensor.min_range_m"));
  Sensor fan;
  fan.model = Model::beam;
  fan.beams = 720;
  fan.beam_step_rad = 0.01;
  EXPECT_TRUE(names(check(fan), "sensor.beam_step_rad"));
}

TEST(Params, ConstructionThrowsWithTheNames) {
  try {
    Map map({.cell_m = 0});
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("map.cell_m"), std::string::npos);
  }
  Map map({.cell_m = 0.001}, make_serial_executor());
  Sensor far;
  far.max_range_m = 1000;
  EXPECT_THROW(map.add(far), std::invalid_argument);
}

TEST(Params, MapsTakeOnlyTheRulesTheyHavePlanesFor) {
  EXPECT_EQ(map_rules().size(), static_cast<std::size_t>(kMapRuleCount));
  for (const Rule r : all_rules()) {
    const auto errors = check(MapParams{.rule = r});
    const bool of_maps = std::find(map_rules().begin(), map_rules().end(), r) != map_rules().end();
    EXPECT_EQ(errors.empty(), of_maps) << name(r);
    EXPECT_EQ(why_not_in_maps(r).empty(), of_maps) << name(r);
    if (of_maps) continue;
    EXPECT_EQ(errors[0].field, "map.rule");
    EXPECT_NE(errors[0].reason.find(name(r)), std::string::npos);
    EXPECT_THROW(Map({.rule = r}, make_serial_executor()), std::invalid_argument);
  }
}

TEST(Params, PairsThatDoNotFitAreRefusedByName) {
  int allowed = 0;
  for (const Rule rule : map_rules()) {
    for (const Model model : all_models()) {
      const bool probability = model == Model::probability,
                 member = model == Model::fuzzy || model == Model::moravec1985;
      const bool fits = probability ? rule == Rule::bayes : !member || rule == Rule::fuzzy;
      EXPECT_EQ(why_not_together(rule, model).empty(), fits) << name(rule) << ' ' << name(model);
      Map map({.rule = rule}, make_serial_executor());
      Sensor s;
      s.model = model;
      s.beam_step_rad = 0.01;
      if (fits) {
        ++allowed;
        EXPECT_NO_THROW(map.add(s)) << name(rule) << ' ' << name(model);
        continue;
      }
      try {
        map.add(s);
        ADD_FAILURE() << name(rule) << ' ' << name(model);
      } catch (const std::invalid_argument& e) {
        EXPECT_NE(
            std::string(e.what()).find(std::string(name(model)) + " cannot be fused by " + std::string(name(rule))),
            std::string::npos)
            << e.what();
      }
    }
  }
  EXPECT_GT(allowed, 50);
}

TEST(Params, EveryModelParameterIsReadWrittenAndChecked) {
  for (const Model model : all_models()) {
    ASSERT_FALSE(model_params(model).empty());
    for (const ModelParam& p : model_params(model)) {
      Sensor s;
      s.model = model;
      s.beam_step_rad = 0.01;
      EXPECT_EQ(model_param(s, model, p.name), p.standard);
      EXPECT_TRUE(p.standard >= p.least && p.standard <= p.most) << p.name;
      const double other = p.is_switch ? 1 - p.standard : (p.least + p.most) / 2;
      EXPECT_TRUE(set_model_param(s, model, p.name, other));
      EXPECT_EQ(model_param(s, model, p.name), other) << p.name;
      if (p.is_switch) continue;
      EXPECT_TRUE(set_model_param(s, model, p.name, p.most * 1.01 + 1));
      bool named = false;
      for (const auto& e : check(s)) named = named || e.field.ends_with(p.name);
      EXPECT_TRUE(named) << name(model) << ' ' << p.name;
    }
  }
  Sensor s;
  EXPECT_FALSE(set_model_param(s, Model::li2006, "nonsense", 1));
  EXPECT_FALSE(model_param(s, Model::li2006, "nonsense"));
}

TEST(Params, NamesRoundTrip) {
  for (const Rule r : all_rules()) EXPECT_EQ(rule_from_name(name(r)), r);
  for (const Model m : all_models()) EXPECT_EQ(model_from_name(name(m)), m);
  EXPECT_FALSE(rule_from_name("nonsense"));
  for (int i = 0; i < kRefusalCount; ++i) EXPECT_NE(name(static_cast<Refusal>(i)), "?");
}

}  // namespace
}  // namespace evigrid
