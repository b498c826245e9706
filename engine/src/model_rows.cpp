// SPDX-License-Identifier: Apache-2.0
#include "model_rows.hpp"

#include <array>

#include "kernels/row/reading.hpp"

namespace evigrid {
namespace {

using enum Says;
constexpr auto kRows = std::to_array<ModelRow>({
    {Model::hughes1992, "hughes1992", kernels::kHughes1992, masses, kHughesRows},
    {Model::oriolo1997, "oriolo1997", kernels::kOriolo1997, masses, kOrioloRows},
    {Model::li2006, "li2006", kernels::kLi2006, masses, kLi2006Rows},
    {Model::li2014, "li2014", kernels::kLi2014, masses, kLiRows},
    {Model::probability, "probability", kernels::kProbability, probability, kProbabilityRows},
    {Model::fuzzy, "fuzzy", kernels::kFuzzyModel, memberships, kFuzzyRows},
    {Model::moravec1985, "moravec1985", kernels::kMoravec1985, memberships, kMoravecRows},
    {Model::beam, "beam", -1, masses, kBeamRows},
});
static_assert(kRows.size() == kModelCount);

constexpr auto kAll = [] {
  std::array<Model, kRows.size()> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = kRows[i].model;
  return out;
}();
static_assert(
    [] {
      for (std::size_t i = 0; i < kRows.size(); ++i) {
        if (static_cast<std::size_t>(kRows[i].model) != i) return false;
      }
      return true;
    }(),
    "rows in the order of Model");

std::string_view short_name(const ParamRow<Sensor>& row) { return row.field.substr(row.field.rfind('.') + 1); }

const ParamRow<Sensor>* find_param(Model m, std::string_view text) {
  for (const auto& row : model_row(m).params) {
    if (short_name(row) == text) return &row;
  }
  return nullptr;
}

}  // namespace

const ModelRow& model_row(Model m) noexcept { return kRows[static_cast<std::size_t>(m)]; }

std::string_view name(Model m) noexcept {
  const auto i = static_cast<std::size_t>(m);
  return i < kRows.size() ? kRows[i].name : "?";
}
std::optional<Model> model_from_name(std::string_view text) noexcept {
  for (const ModelRow& row : kRows) {
    if (row.name == text) return row.model;
  }
  return std::nullopt;
}
std::span<const Model> all_models() noexcept { return kAll; }

std::string_view why_not_together(Rule rule, Model m) noexcept {
  const ModelRow& row = model_row(m);
  if (row.says == memberships && rule != Rule::fuzzy)
    return "it says memberships, which are no masses; its rule is fuzzy";
  if (row.says == probability && rule != Rule::bayes) return "it says a probability and no masses; its rule is bayes";
  return "";
}

std::vector<ModelParam> model_params(Model m) {
  std::vector<ModelParam> out;
  const Sensor standard;
  for (const auto& row : model_row(m).params) {
    out.push_back({short_name(row), row.unit, row.least, row.most, row.get(standard), row.is_switch, row.source});
  }
  return out;
}
std::optional<double> model_param(const Sensor& s, Model m, std::string_view text) {
  const auto* row = find_param(m, text);
  return row ? std::optional(row->get(s)) : std::nullopt;
}
bool set_model_param(Sensor& s, Model m, std::string_view text, double value) {
  const auto* row = find_param(m, text);
  if (row) row->set(s, value);
  return row != nullptr;
}

}  // namespace evigrid
