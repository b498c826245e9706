// SPDX-License-Identifier: Apache-2.0
// The words of the field, as types. Metres, radians, nanoseconds; frame M = map, R = robot, S = sensor;
// T_map_robot takes robot coordinates to map coordinates. Cell (ix, iy) covers [ix·c, (ix+1)·c) × [iy·c, (iy+1)·c)
// of frame M, c = cell_m: the grid has no origin and no border.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "evigrid/export.hpp"

namespace EVIGRID_API evigrid {

/// Yaw is counter-clockwise from x (REP 103).
struct Pose2 {
  double x_m = 0, y_m = 0, yaw_rad = 0;
};

/// a ∘ b: `b` expressed in the frame that `a` maps into, e.g. T_map_sensor = compose(T_map_robot, T_robot_sensor).
Pose2 compose(const Pose2& a, const Pose2& b) noexcept;

/// A point of frame M, m.
struct Point2 {
  double x_m = 0, y_m = 0;
};

struct CellIndex {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const CellIndex&, const CellIndex&) = default;
};

/// Half-open rectangle of cells; empty when width or height is 0.
struct CellRect {
  std::int64_t x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] bool empty() const noexcept { return width <= 0 || height <= 0; }
  friend bool operator==(const CellRect&, const CellRect&) = default;
};

/// Belief masses of one cell on the frame {empty, occupied}: m(empty), m(occupied), m(unknown), and c, the mass on
/// empty ∩ occupied (m(∅) in the open world), 0 under every rule of maps but conjunctive, dsmc and fuzzy. They add up
/// to 1 (fuzzy: memberships, which do not); the vacuous cell is (0, 0, 1).
struct Mass {
  float e = 0, o = 0, u = 1, c = 0;
  friend bool operator==(const Mass&, const Mass&) = default;
};

/// Combination rules (docs/maths.md, with sources). The first kMapRuleCount can be the rule of a map; all work in
/// combine(). dempster_log is Dempster's rule with the cells of a map kept as sums of log-weights: it never saturates,
/// the order of readings does not change a bit, and a scan can be taken back; in combine() it is dempster.
enum class Rule : std::uint8_t {
  dempster,
  pcr2,
  pcr5,
  germ_pcr2,
  yager,
  dubois_prade,
  dsmh,
  pcr1,
  pcr3,
  pcr4,
  pcr6,
  pcr5plus,
  pcr6plus,
  conjunctive,
  dsmc,
  cautious,
  murphy,
  bayes,
  fuzzy,
  dempster_log,
  disjunctive
};
inline constexpr int kRuleCount = 21, kMapRuleCount = 20;

/// Inverse sensor models: sonar cones, and beam, a fan of laser beams. probability says P(occupied), fuzzy and
/// moravec1985 say memberships of two sets, all others masses.
enum class Model : std::uint8_t { hughes1992, oriolo1997, li2006, li2014, probability, fuzzy, moravec1985, beam };
inline constexpr int kModelCount = 8;

/// Which table of kernels runs. `automatic` takes the widest that the processor supports. cuda: readings are fused on
/// the first GPU, tiles stay there and come back after each call; never chosen by itself.
enum class Kernel : std::uint8_t { automatic, scalar, avx2, avx512, cuda };

std::string_view name(Rule) noexcept;
std::string_view name(Model) noexcept;
std::string_view name(Kernel) noexcept;
std::optional<Rule> rule_from_name(std::string_view) noexcept;
std::optional<Model> model_from_name(std::string_view) noexcept;
std::optional<Kernel> kernel_from_name(std::string_view) noexcept;
std::span<const Rule> all_rules() noexcept;
std::span<const Rule> map_rules() noexcept;
/// The first rule that gives the same for two sources on this frame: itself but for pcr3 (pcr2), pcr6, pcr5plus and
/// pcr6plus (pcr5), dubois_prade (yager) and dsmc (conjunctive). dempster_log counts as itself.
Rule same_as(Rule) noexcept;
/// Whether the rule leaves a mass on empty ∩ occupied: conjunctive, dsmc, fuzzy.
bool keeps_paradox(Rule) noexcept;
/// Empty for the rules of maps, else the reason.
std::string_view why_not_in_maps(Rule) noexcept;
std::span<const Model> all_models() noexcept;
/// Empty when the rule can fuse what the model says, else the reason.
std::string_view why_not_together(Rule, Model) noexcept;

/// Raised when a change alters the bits of a map; in every map file and report.json.
inline constexpr int kMathsVersion = 3;

}  // namespace evigrid
