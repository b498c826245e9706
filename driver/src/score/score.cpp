// SPDX-License-Identifier: Apache-2.0
#include "score/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace evigrid::driver {
namespace {

using scenes::TruthCell;

constexpr double kLeastProbability = 1e-6;  // one certain mistake must not outweigh a whole map

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(part) / static_cast<double>(whole);
}

/// Whether any of the up to nine cells around (x, y) satisfies `is`.
template <class Is>
bool near_by(const CellRect& rect, std::int64_t x, std::int64_t y, Is is) {
  for (std::int64_t v = std::max<std::int64_t>(y - 1, 0); v <= std::min(y + 1, rect.height - 1); ++v) {
    for (std::int64_t u = std::max<std::int64_t>(x - 1, 0); u <= std::min(x + 1, rect.width - 1); ++u) {
      if (is(static_cast<std::size_t>(v * rect.width + u))) return true;
    }
  }
  return false;
}

struct Counts {
  std::uint64_t called = 0, rightly = 0, walls = 0, found = 0, decided = 0, mistaken = 0;
  [[nodiscard]] Agreement agreement() const {
    return {share(rightly, called), share(found, walls), share(mistaken, decided)};
  }
};

void count_cells(const Overlay& o, Score& score) {
  Counts strict, near;
  std::uint64_t free = 0, known = 0;
  for (std::int64_t y = 0; y < o.rect.height; ++y) {
    for (std::int64_t x = 0; x < o.rect.width; ++x) {
      const auto i = static_cast<std::size_t>(y * o.rect.width + x);
      const TruthCell truth = o.truth[i];
      const Decision said = o.map[i];
      ++score.confusion[static_cast<std::size_t>(truth)][static_cast<std::size_t>(said)];
      const bool wall = truth == TruthCell::surface;
      const bool found = wall && near_by(o.rect, x, y, [&](std::size_t k) { return o.map[k] == Decision::occupied; });
      if (truth == TruthCell::free) {
        ++free;
        known += said != Decision::unknown;
      }
      if (visible_wall(o, i)) {
        ++strict.walls, ++near.walls;
        strict.found += said == Decision::occupied;
        near.found += found;
      }
      if (said == Decision::unknown) continue;
      ++strict.decided, ++near.decided;
      if (said == Decision::occupied) {
        const bool near_wall = near_by(o.rect, x, y, [&](std::size_t k) { return o.truth[k] != TruthCell::free; });
        ++strict.called, ++near.called;
        strict.rightly += truth != TruthCell::free;
        near.rightly += near_wall;
        strict.mistaken += truth == TruthCell::free;
        near.mistaken += !near_wall;
      } else if (truth != TruthCell::free) {
        ++strict.mistaken;
        const bool beside_free = near_by(o.rect, x, y, [&](std::size_t k) { return o.truth[k] == TruthCell::free; });
        near.mistaken += wall ? !found : !beside_free;
      }
    }
  }
  score.strict = strict.agreement();
  score.near = near.agreement();
  score.known_share = share(known, free);
  const auto occupied = static_cast<std::size_t>(Decision::occupied);
  score.out_of_sight_share =
      share(score.confusion[static_cast<std::size_t>(TruthCell::solid)][occupied], strict.called);
}

struct Belief {
  double e = 0, o = 0, u = 1;
};

class Means {
 public:
  void add(const Belief& m, bool occupied) {
    const double betp = m.o + 0.5 * m.u, plp = (m.o + m.u) / (m.o + m.e + 2 * m.u);
    ++n_;
    score_.log_loss_betp += loss(betp, occupied);
    score_.log_loss_plp += loss(plp, occupied);
    score_.brier_betp += square(betp - occupied);
    score_.brier_plp += square(plp - occupied);
    const double p = clamped(betp);
    score_.map_score += 1 + std::log2(occupied ? p : 1 - p);
    score_.entropy -= p * std::log2(p) + (1 - p) * std::log2(1 - p);
    score_.ignorance += m.u;
  }
  void write(Score& to) const {
    const double n = n_ == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(n_);
    for (double Score::*mean : {&Score::log_loss_betp, &Score::log_loss_plp, &Score::brier_betp, &Score::brier_plp,
                                &Score::map_score, &Score::entropy, &Score::ignorance}) {
      to.*mean = score_.*mean / n;
    }
  }

 private:
  static double square(double x) { return x * x; }
  static double clamped(double p) { return std::clamp(p, kLeastProbability, 1 - kLeastProbability); }
  static double loss(double p, bool occupied) { return -std::log(occupied ? clamped(p) : 1 - clamped(p)); }
  Score score_;
  std::uint64_t n_ = 0;
};

}  // namespace

Decision decide(float e, float o, float u) noexcept {
  if (!(u < 0.5F) || e == o) return Decision::unknown;
  return o > e ? Decision::occupied : Decision::empty;
}

bool visible_wall(const Overlay& o, std::size_t i) {
  const auto at = static_cast<std::int64_t>(i);
  return o.truth[i] == TruthCell::surface && near_by(o.rect, at % o.rect.width, at / o.rect.width,
                                                     [&](std::size_t k) { return o.truth[k] == TruthCell::free; });
}

Overlay overlay(const Layers& map, const scenes::TruthGrid& truth) {
  Overlay out;
  const CellRect& m = map.rect;
  if (m.empty()) {
    out.rect = {truth.x, truth.y, truth.width, truth.height};
  } else {
    out.rect.x = std::min(m.x, truth.x);
    out.rect.y = std::min(m.y, truth.y);
    out.rect.width = std::max(m.x + m.width, truth.x + truth.width) - out.rect.x;
    out.rect.height = std::max(m.y + m.height, truth.y + truth.height) - out.rect.y;
  }
  const auto n = static_cast<std::size_t>(out.rect.width) * static_cast<std::size_t>(out.rect.height);
  out.truth.resize(n);
  out.map.resize(n, Decision::unknown);
  std::size_t i = 0;
  for (std::int64_t y = out.rect.y; y < out.rect.y + out.rect.height; ++y) {
    for (std::int64_t x = out.rect.x; x < out.rect.x + out.rect.width; ++x, ++i) {
      out.truth[i] = truth.at(std::clamp(x, truth.x, truth.x + truth.width - 1),
                              std::clamp(y, truth.y, truth.y + truth.height - 1));
      const std::int64_t mx = x - m.x, my = y - m.y;
      if (mx < 0 || my < 0 || mx >= m.width || my >= m.height) continue;
      const auto k = static_cast<std::size_t>(my * m.width + mx);
      out.map[i] = decide(map.e()[k], map.o()[k], map.u()[k]);
    }
  }
  return out;
}

Score score(const Layers& map, const scenes::TruthGrid& truth) { return score(map, truth, overlay(map, truth)); }

Score score(const Layers& map, const scenes::TruthGrid& truth, const Overlay& both) {
  Score out;
  count_cells(both, out);
  Means means;
  const CellRect& m = map.rect;
  for (std::int64_t y = truth.y; y < truth.y + truth.height; ++y) {
    for (std::int64_t x = truth.x; x < truth.x + truth.width; ++x) {
      const TruthCell cell = truth.at(x, y);
      if (cell == TruthCell::solid) continue;
      Belief belief;
      const std::int64_t mx = x - m.x, my = y - m.y;
      if (mx >= 0 && my >= 0 && mx < m.width && my < m.height) {
        const auto k = static_cast<std::size_t>(my * m.width + mx);
        const double known = static_cast<double>(map.e()[k]) + map.o()[k] + map.u()[k];  // without m(∅)
        const double by = map.optional(map.paradox, k) > 0 && known > 0 ? known : 1;
        belief = {map.e()[k] / by, map.o()[k] / by, map.u()[k] / by};
      }
      means.add(belief, cell == TruthCell::surface);
    }
  }
  means.write(out);
  return out;
}

nlohmann::ordered_json to_json(const Score& s) {
  using Json = nlohmann::ordered_json;
  const auto agreement = [](const Agreement& a) {
    return Json{{"precision", a.precision}, {"recall", a.recall}, {"mistaken_rate", a.mistaken_rate}};
  };
  const auto row = [&](scenes::TruthCell truth) {
    const auto& r = s.confusion[static_cast<std::size_t>(truth)];
    return Json{{"unknown", r[0]}, {"empty", r[1]}, {"occupied", r[2]}};
  };
  Json out;
  out["strict"] = agreement(s.strict);
  out["within_one_cell"] = agreement(s.near);
  out["known_share_of_free"] = s.known_share;
  out["out_of_sight_share_of_occupied"] = s.out_of_sight_share;
  out["log_loss_betp"] = s.log_loss_betp;
  out["log_loss_plp"] = s.log_loss_plp;
  out["brier_betp"] = s.brier_betp;
  out["brier_plp"] = s.brier_plp;
  out["map_score"] = s.map_score;
  out["entropy_bits"] = s.entropy;
  out["ignorance"] = s.ignorance;
  out["confusion_cells"] = {
      {"free", row(TruthCell::free)}, {"surface", row(TruthCell::surface)}, {"solid", row(TruthCell::solid)}};
  return out;
}

}  // namespace evigrid::driver
