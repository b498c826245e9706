// SPDX-License-Identifier: Apache-2.0
// The words of the field, as types. Metres, radians, nanoseconds; frame M = map, R = robot, S = sensor;
// T_map_robot takes robot coordinates to map coordinates. Cell (ix, iy) covers [ix·c, (ix+1)·c) × [iy·c, (iy+1)·c)
// of frame M, c = cell_m: the grid has no origin and no border.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace evigrid {

struct Pose2 {
  double x_m = 0, y_m = 0, yaw_rad = 0;
};

/// a ∘ b: `b` expressed in the frame that `a` maps into, e.g. T_map_sensor = compose(T_map_robot, T_robot_sensor).
Pose2 compose(const Pose2& a, const Pose2& b) noexcept;

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

/// Belief masses of one cell on the frame {empty, occupied}: m(empty), m(occupied), m(unknown).
/// They add up to 1; the vacuous cell is (0, 0, 1).
struct Mass {
  float e = 0, o = 0, u = 1;
  friend bool operator==(const Mass&, const Mass&) = default;
};

/// Combination rules (docs/maths.md, with sources). The first kMapRuleCount can be the rule of a map; the others leave
/// what a map has no plane for and work in combine().
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
  disjunctive,
  cautious,
  murphy,
  bayes,
  fuzzy
};
inline constexpr int kRuleCount = 20, kMapRuleCount = 13;

/// Inverse sensor models. hughes1992 and li2014 are sonar cones, beam is a fan of laser beams.
enum class Model : std::uint8_t { hughes1992, li2014, beam };
inline constexpr int kModelCount = 3;

/// Which table of kernels runs. `automatic` takes the widest that the processor supports.
enum class Kernel : std::uint8_t { automatic, scalar, avx2, avx512 };

/// What `render` draws. betp: pignistic probability of occupied, o + u/2. bel: o. pl: o + u.
/// conflict: running sum of the conflict k of every update (0 where the map keeps none).
enum class Layer : std::uint8_t { betp, bel, pl, empty, unknown, conflict };

std::string_view name(Rule) noexcept;
std::string_view name(Model) noexcept;
std::string_view name(Kernel) noexcept;
std::string_view name(Layer) noexcept;
std::optional<Rule> rule_from_name(std::string_view) noexcept;
std::optional<Model> model_from_name(std::string_view) noexcept;
std::optional<Kernel> kernel_from_name(std::string_view) noexcept;
std::span<const Rule> all_rules() noexcept;
std::span<const Rule> map_rules() noexcept;
/// The first rule that gives the same for two sources on this frame: itself but for pcr3 (pcr2), pcr6, pcr5plus and
/// pcr6plus (pcr5), dubois_prade (yager) and dsmc (conjunctive).
Rule same_as(Rule) noexcept;
/// Empty for the rules of maps, else the reason.
std::string_view why_not_in_maps(Rule) noexcept;
std::span<const Model> all_models() noexcept;

/// Raised when a change alters the bits of a map; part of every report.
inline constexpr int kMathsVersion = 2;

}  // namespace evigrid
