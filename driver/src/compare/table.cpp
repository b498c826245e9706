// SPDX-License-Identifier: Apache-2.0
#include "compare/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace evigrid::driver {
namespace {

/// A column: its head, and its value in a row as text. Scores are left blank where there is no truth.
struct Column {
  const char* head;
  std::string (*text)(const CompareRow&);
};

std::string figure(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : ""; }

/// Of the readings compared: those that the map does not expect to hear.
double silent_share(const Rerendered& r) {
  return r.readings == 0 ? NAN : static_cast<double>(r.silent) / static_cast<double>(r.readings);
}

std::string flips(int count) { return count >= kMostFlips ? "never" : fmt::format("{}", count); }

template <double Agreement::*Value, Agreement Score::*How>
std::string agreement(const CompareRow& r) {
  return r.score ? figure((*r.score).*How.*Value) : "";
}

template <double Score::*Value>
std::string scored(const CompareRow& r) {
  return r.score ? figure((*r.score).*Value) : "";
}

const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"robot", [](const CompareRow& r) { return r.robot; }},
      {"rule", [](const CompareRow& r) { return r.rule; }},
      {"model", [](const CompareRow& r) { return r.model; }},
      {"cells_updated", [](const CompareRow& r) { return fmt::format("{}", r.cells_updated); }},
      {"fusion_s", [](const CompareRow& r) { return figure(r.fusion_s); }},
      {"precision", agreement<&Agreement::precision, &Score::strict>},
      {"recall", agreement<&Agreement::recall, &Score::strict>},
      {"mistaken_rate", agreement<&Agreement::mistaken_rate, &Score::strict>},
      {"precision_1cell", agreement<&Agreement::precision, &Score::near>},
      {"recall_1cell", agreement<&Agreement::recall, &Score::near>},
      {"mistaken_rate_1cell", agreement<&Agreement::mistaken_rate, &Score::near>},
      {"known_share", scored<&Score::known_share>},
      {"out_of_sight_share", scored<&Score::out_of_sight_share>},
      {"log_loss_betp", scored<&Score::log_loss_betp>},
      {"log_loss_plp", scored<&Score::log_loss_plp>},
      {"brier_betp", scored<&Score::brier_betp>},
      {"brier_plp", scored<&Score::brier_plp>},
      {"map_score", scored<&Score::map_score>},
      {"entropy_bits", scored<&Score::entropy>},
      {"mean_conflict", [](const CompareRow& r) { return figure(r.mean_conflict); }},
      {"ignorance", [](const CompareRow& r) { return figure(r.ignorance); }},
      {"rerender_median_m", [](const CompareRow& r) { return figure(r.rerendered.median_m); }},
      {"rerender_mean_m", [](const CompareRow& r) { return figure(r.rerendered.mean_m); }},
      {"rerender_silent_share", [](const CompareRow& r) { return figure(silent_share(r.rerendered)); }},
      {"readings_to_flip", [](const CompareRow& r) { return flips(r.flips); }},
      {"total_conflicts", [](const CompareRow& r) { return fmt::format("{}", r.total_conflicts); }},
      {"readings_used", [](const CompareRow& r) { return fmt::format("{}", r.readings_used); }},
      {"readings_refused", [](const CompareRow& r) { return fmt::format("{}", r.readings_refused); }},
      {"map_hash", [](const CompareRow& r) { return r.map_hash; }}};
  return all;
}

/// Columns that say something in at least one row.
std::vector<const Column*> used_columns(const std::vector<CompareRow>& rows) {
  std::vector<const Column*> used;
  for (const Column& c : columns()) {
    if (std::any_of(rows.begin(), rows.end(), [&](const CompareRow& r) { return !c.text(r).empty(); })) {
      used.push_back(&c);
    }
  }
  return used;
}

}  // namespace

std::string to_csv(const std::vector<CompareRow>& rows) {
  std::string out;
  for (const Column& c : columns()) {
    if (!out.empty()) out += ',';
    out += c.head;
  }
  out += '\n';
  for (const CompareRow& row : rows) {
    bool first = true;
    for (const Column& c : columns()) {
      if (!std::exchange(first, false)) out += ',';
      out += c.text(row);
    }
    out += '\n';
  }
  return out;
}

std::string to_markdown(const std::vector<CompareRow>& rows) {
  const auto used = used_columns(rows);
  std::string head = "|", rule = "|", body;
  for (const Column* c : used) {
    head += fmt::format(" {} |", c->head);
    rule += "---|";
  }
  for (const CompareRow& row : rows) {
    body += '|';
    for (const Column* c : used) body += fmt::format(" {} |", c->text(row));
    body += '\n';
  }
  return head + '\n' + rule + '\n' + body;
}

namespace {

nlohmann::ordered_json to_json(const Rerendered& r) {
  const auto number = [](double v) { return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(); };
  return {{"readings", r.readings},
          {"silent_share", number(silent_share(r))},
          {"median_m", number(r.median_m)},
          {"mean_m", number(r.mean_m)}};
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<CompareRow>& rows) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const CompareRow& r : rows) {
    nlohmann::ordered_json row{{"rule", r.rule},
                               {"model", r.model},
                               {"cells_updated", r.cells_updated},
                               {"readings_used", r.readings_used},
                               {"readings_refused", r.readings_refused},
                               {"total_conflicts", r.total_conflicts},
                               {"fusion_s", r.fusion_s},
                               {"mean_conflict", r.mean_conflict},
                               {"ignorance", r.ignorance},
                               {"rerender", to_json(r.rerendered)},
                               {"readings_to_flip", flips(r.flips)},
                               {"map_hash", r.map_hash}};
    if (!r.robot.empty()) row["robot"] = r.robot;
    if (r.score) row["score"] = to_json(*r.score);
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace evigrid::driver
