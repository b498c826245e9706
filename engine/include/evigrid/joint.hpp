// SPDX-License-Identifier: Apache-2.0
// Several sources on a cell at once, where that is another result than one after the other; and states that put the
// redistribution of conflict off until somebody reads. Masses as in combine.hpp.
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "evigrid/combine.hpp"
#include "evigrid/export.hpp"

namespace EVIGRID_API evigrid {

inline constexpr int kMostJointSources = 8;

/// Whether all sources at once are another result than in order: yager, dubois_prade, dsmh, pcr1 … pcr6, pcr5plus,
/// pcr6plus. The associative rules give the same either way; germ_pcr2 is defined for two sources.
[[nodiscard]] bool has_joint_form(Rule) noexcept;

/// C = the joint combination of up to kMostJointSources sources, n cells each. What each rule does with a conflicting
/// product: docs/maths.md. A source's c is given back (pcr), consumed (dsmh) or dropped; c of the result is 0.
/// `conflict` (may be null) receives the product mass on the empty set. In double, scalar; floats are rounded at the
/// end. Throws std::invalid_argument for a rule without a joint form, no source, or too many.
void combine_joint(Rule, std::span<const Planes<const double>> sources, Planes<double> c, double* conflict,
                   std::size_t n, Executor* = nullptr);
void combine_joint(Rule, std::span<const Planes<const float>> sources, Planes<float> c, float* conflict, std::size_t n,
                   Executor* = nullptr);

/// Deferred combination (Yager, PCR1, PCR2): a cell keeps the conjunctive part and the column sums, whatever the number
/// of readings, in an order-free state of seven numbers; reading redistributes the conflict once, so that it equals
/// the joint form of all that was added. Over long runs the conjunctive part vanishes and PCR1 and PCR2 tend to the
/// average of the readings: keep windows short.
class DeferredCells {
 public:
  explicit DeferredCells(std::size_t cells) : cells_(cells) {}
  /// One more reading of a cell. e + o + u = 1, which is not checked. As clear() and read(), throws std::out_of_range
  /// for a cell that is not there.
  void add(std::size_t cell, double e, double o, double u);
  void clear(std::size_t cell) { cells_.at(cell) = {}; }
  [[nodiscard]] std::size_t size() const noexcept { return cells_.size(); }

  struct Read {
    double e = 0, o = 0, u = 1, k = 0;  ///< k: the conflict that was redistributed
  };
  /// By yager, dubois_prade, pcr1, pcr2 or pcr3; std::invalid_argument for another rule.
  [[nodiscard]] Read read(Rule, std::size_t cell) const;

 private:
  struct Cell {
    double e = 0, o = 0, t = 1, k = 0;  // conjunctive, adding up to 1
    double column_e = 0, column_o = 0, column_u = 0;
  };
  std::vector<Cell> cells_;
};

/// The last few readings of each cell, combined in order when read (Li, Huang & Dezert, chapter 14 of Advances and
/// Applications of DSmT, vol. 2, 2006: five readings). A reading beyond `depth` replaces the oldest.
class WindowCells {
 public:
  /// Throws std::invalid_argument unless 1 ≤ depth ≤ 64.
  explicit WindowCells(std::size_t cells, int depth = 5);
  /// c is dropped. As clear() and count(), throws std::out_of_range for a cell that is not there.
  void add(std::size_t cell, const Mass&);
  void clear(std::size_t cell) { count_.at(cell) = 0; }
  [[nodiscard]] int count(std::size_t cell) const {
    return static_cast<int>(std::min<std::uint64_t>(count_.at(cell), depth_));
  }
  /// All cells: vacuous where nothing was added. One call of combine() a step, by any rule of two sources. Throws as
  /// it.
  void read(Rule, Planes<float> out, Kernel = Kernel::automatic, Executor* = nullptr) const;

 private:
  std::uint64_t depth_;
  std::vector<Mass> masses_;  // depth of a cell side by side, as a ring
  std::vector<std::uint64_t> count_;
};

}  // namespace evigrid
