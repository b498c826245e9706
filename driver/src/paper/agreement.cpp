// SPDX-License-Identifier: Apache-2.0
#include "paper/agreement.hpp"

#include <fmt/format.h>

#include "picture/look.hpp"

namespace evigrid::driver {

std::vector<Finding> agreement(const std::string& which, const Score& score, const Floors& floors) {
  const auto finding = [&](const char* what, double value, const char* relation, double bound, bool met,
                           const char* how) {
    return Finding{fmt::format("{}: {}", which, what),
                   fmt::format("our floor: {} {:g}", relation, bound),
                   fmt::format("{:.3f}", value),
                   Aim::floor,
                   met,
                   how,
                   value};
  };
  const Agreement& a = score.near;
  return {finding("precision", a.precision, "at least", floors.precision, a.precision >= floors.precision,
                  "of the cells called occupied: share with a true wall within one cell"),
          finding("recall", a.recall, "at least", floors.recall, a.recall >= floors.recall,
                  "of the true walls that border free space: share called occupied within one cell"),
          finding("mistaken rate", a.mistaken_rate, "at most", floors.mistaken_rate,
                  a.mistaken_rate <= floors.mistaken_rate,
                  "of the decided cells: share called what they are not, one cell forgiven")};
}

MetricTable metric_table(const std::vector<ScoredMap>& maps) {
  MetricTable out;
  out.head = {"map",
              "precision",
              "recall",
              "mistaken",
              "precision, near",
              "recall, near",
              "mistaken, near",
              "free known",
              "log-loss BetP",
              "log-loss PlP",
              "Brier BetP",
              "Brier PlP",
              "map score",
              "entropy, bit",
              "m(unknown)",
              "conflict",
              "re-rendered: median, m",
              "mean, m",
              "no echo predicted"};
  for (const ScoredMap& m : maps) {
    const Score& s = m.score;
    std::vector<std::string> row{m.name};
    for (const double v : {s.strict.precision, s.strict.recall, s.strict.mistaken_rate, s.near.precision, s.near.recall,
                           s.near.mistaken_rate, s.known_share, s.log_loss_betp, s.log_loss_plp, s.brier_betp,
                           s.brier_plp, s.map_score, s.entropy, s.ignorance, m.mean_conflict}) {
      row.push_back(fmt::format("{:.3f}", v));
    }
    if (m.rerendered) {
      const Rerendered& r = *m.rerendered;
      row.push_back(fmt::format("{:.3f}", r.median_m));
      row.push_back(fmt::format("{:.3f}", r.mean_m));
      row.push_back(fmt::format("{} of {}", r.silent, r.readings));
    } else {
      row.resize(row.size() + 3);
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

double mean_conflict(const Layers& layers) {
  double sum = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < layers.cells(); ++i) {
    if (never_seen(layers, i)) continue;
    sum += layers.conflict()[i];
    ++seen;
  }
  return seen == 0 ? 0 : sum / static_cast<double>(seen);
}

}  // namespace evigrid::driver
