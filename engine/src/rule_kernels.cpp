// SPDX-License-Identifier: Apache-2.0
// The one list of rules: name, kernel, and why a map cannot keep what the rule leaves. The identities (Dubois & Prade =
// Yager, PCR3 = PCR2, PCR6 = PCR5+ = PCR6+ = PCR5, DSmC = conjunctive, for two sources on two hypotheses) are held by tests against
// each rule's own definition.
#include "rule_kernels.hpp"

#include <array>

namespace evigrid {
namespace {

using namespace kernels;

struct Row {
  Rule rule;
  std::string_view name;
  RuleKernel kernel;
  std::string_view not_in_maps;
};
constexpr auto kRows = std::to_array<Row>({
    {Rule::dempster, "dempster", kDempster, ""},
    {Rule::pcr2, "pcr2", kPcr2, ""},
    {Rule::pcr5, "pcr5", kPcr5, ""},
    {Rule::germ_pcr2, "germ_pcr2", kGermPcr2, ""},
    {Rule::yager, "yager", kYager, ""},
    {Rule::dubois_prade, "dubois_prade", kYager, ""},
    {Rule::dsmh, "dsmh", kDsmh, ""},
    {Rule::pcr1, "pcr1", kPcr1, ""},
    {Rule::pcr3, "pcr3", kPcr2, ""},
    {Rule::pcr4, "pcr4", kPcr4, ""},
    {Rule::pcr6, "pcr6", kPcr5, ""},
    {Rule::pcr5plus, "pcr5plus", kPcr5, ""},
    {Rule::pcr6plus, "pcr6plus", kPcr5, ""},
    {Rule::conjunctive, "conjunctive", kConjunctive, ""},
    {Rule::dsmc, "dsmc", kConjunctive, ""},
    {Rule::cautious, "cautious", kCautious, ""},
    {Rule::murphy, "murphy", kMurphy, ""},
    {Rule::bayes, "bayes", kBayes, ""},
    {Rule::fuzzy, "fuzzy", kFuzzy, ""},
    {Rule::dempster_log, "dempster_log", kDempsterLog, ""},
    {Rule::disjunctive, "disjunctive", kDisjunctive, "a cell that starts unknown would stay unknown for ever"},
});
static_assert(kRows.size() == kRuleCount);

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const bool in_maps = i < kMapRuleCount;
    if (static_cast<std::size_t>(kRows[i].rule) != i || kRows[i].not_in_maps.empty() != in_maps) return false;
    if (in_maps != (kRows[i].kernel < kRules)) return false;
  }
  return true;
}
static_assert(in_order(), "rows in the order of Rule, those of maps first");

constexpr auto kAll = [] {
  std::array<Rule, kRows.size()> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = kRows[i].rule;
  return out;
}();

const Row* row_of(Rule r) noexcept {
  const auto i = static_cast<std::size_t>(r);
  return i < kRows.size() ? &kRows[i] : nullptr;
}

}  // namespace

RuleKernel kernel_of(Rule r) noexcept { return row_of(r)->kernel; }
std::string_view name(Rule r) noexcept { return row_of(r) != nullptr ? row_of(r)->name : "?"; }
std::string_view why_not_in_maps(Rule r) noexcept {
  return row_of(r) != nullptr ? row_of(r)->not_in_maps : "no such rule";
}
bool keeps_paradox(Rule r) noexcept { return kernel_of(r) == kConjunctive || kernel_of(r) == kFuzzy; }
Rule same_as(Rule r) noexcept {
  for (const Row& row : kRows) {
    if (row.kernel == kernel_of(r)) return row.rule;
  }
  return r;
}
std::optional<Rule> rule_from_name(std::string_view text) noexcept {
  for (const Row& row : kRows) {
    if (row.name == text) return row.rule;
  }
  return std::nullopt;
}
std::span<const Rule> all_rules() noexcept { return kAll; }
std::span<const Rule> map_rules() noexcept { return std::span(kAll).first(kMapRuleCount); }

}  // namespace evigrid
