// SPDX-License-Identifier: Apache-2.0
// The four methods of Li, Huang & Dezert 2006, section 14.4, on one drive: their maps, their pictures, and how fast
// each follows a change.
#pragma once
#include <array>
#include <cmath>

#include "evigrid/scenes/truth.hpp"
#include "log/log.hpp"
#include "paper/finding.hpp"
#include "paper/paper.hpp"
#include "picture/canvas.hpp"
#include "picture/look.hpp"
#include "score/score.hpp"

namespace evigrid::driver::li2006 {

struct Method {
  const char* name;
  Rule rule;
  Model model;
  Look shown;  ///< what the chapter draws
  const char* shown_as;
};
inline constexpr std::array<Method, 4> kMethods{
    {{"probability", Rule::bayes, Model::probability, Look::betp, "P(occupied)"},
     {"fuzzy", Rule::fuzzy, Model::fuzzy, Look::fuzzy_map, "M"},
     {"DST", Rule::dempster, Model::li2006, Look::bel, "bel(occupied)"},
     {"DSmT + PCR5", Rule::pcr5, Model::li2006, Look::bel, "bel(occupied)"}}};
enum : std::size_t { kProbability, kFuzzy, kDst, kDsmt };

struct Mapped {
  Layers layers;
  Score score;
  double fusion_s = INFINITY;
};

struct Drive {
  Log log;
  double cell_m = 0;
  scenes::TruthGrid truth;
  CellRect rect{};
};

/// @param mirrors surfaces throw sound away beyond 25 degrees, and it may come back by way of a second one: readings
/// that are too long, which the chapter's introduction warns of. Throws InputError.
[[nodiscard]] Drive make_drive(const PaperOptions& options, bool mirrors);

/// The log with every sonar of that model, undiscounted: "all the sonar sensors have the same reliability".
[[nodiscard]] Log as(const Log& log, Model model, double rho_v);
/// The map of the drive by one rule, scored.
[[nodiscard]] Mapped mapped(const Drive& drive, Rule rule, Model model, double rho_v, int threads);

/// Agreement when a cell counts as occupied where what the chapter draws is above ½; cells never seen are unknown.
[[nodiscard]] Agreement as_drawn(const Mapped& map, Look look, const scenes::TruthGrid& truth);
/// What the chapter's figures 14.13 to 14.16 show, beside the true room: grey, black = 1.
[[nodiscard]] Canvas draw_methods(const std::array<Mapped, 4>& maps, const Drive& drive);

/// How many opposite readings turn a cell after 20 agreeing ones, each of mass 0.6 (P = 0.2 and 0.8, which matches by
/// BetP): what a rule makes of a change in the world.
[[nodiscard]] Finding flips();

}  // namespace evigrid::driver::li2006
