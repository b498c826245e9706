// SPDX-License-Identifier: Apache-2.0
// Belief functions on any small frame of discernment, any number of sources at once: for data association (which of
// these beacons was seen?) and teaching. Clear before fast; cells of a map go through combine.hpp, which knows two
// hypotheses only. Every sum runs over tuples of focal elements, as the rules are defined.
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/types.hpp"

namespace EVIGRID_API evigrid {

/// A set of parts of the frame, one bit each; 0 is the empty set.
using Subset = unsigned;

/// Hypotheses by name. Under Shafer's model they exclude each other and a part is a hypothesis; the free DSm model of
/// two has their intersection as a third part: bit 0 only the first, bit 1 only the second, bit 2 both.
class Frame {
 public:
  /// Shafer's model on 1 … 8 hypotheses. Throws std::invalid_argument for another number, an empty or a repeated name,
  /// the names "*" and "{}", and names with '|' or '&'.
  explicit Frame(std::vector<std::string> hypotheses);
  /// The hyper-power set of two: {first ∩ second, first, second, first ∪ second}. Throws for names as above.
  static Frame free_model(std::string first, std::string second);

  [[nodiscard]] std::size_t size() const noexcept { return names_.size(); }  ///< hypotheses
  [[nodiscard]] std::span<const std::string> names() const noexcept { return names_; }
  [[nodiscard]] Subset hypothesis(std::size_t i) const { return sets_.at(i); }  ///< std::out_of_range from size() on
  [[nodiscard]] Subset everything() const noexcept { return (Subset{1} << parts_) - 1; }
  [[nodiscard]] std::size_t subsets() const noexcept { return std::size_t{1} << parts_; }
  /// Whether a mass may stand there: a non-empty set of the power set, of the hyper-power set in the free model.
  [[nodiscard]] bool has(Subset) const noexcept;
  /// "A", "A|C", "A&B" (free model only), "*" everything, "{}" the empty set. Throws std::invalid_argument for names
  /// that are not there and intersections that are empty.
  [[nodiscard]] Subset parse(std::string_view) const;
  [[nodiscard]] std::string text(Subset) const;

 private:
  Frame(std::vector<std::string> names, std::vector<Subset> sets, unsigned parts);
  std::vector<std::string> names_;
  std::vector<Subset> sets_;
  unsigned parts_;
};

/// Masses by Subset, as many as frame.subsets(); m[0] is the mass on the empty set (open world).
struct Belief {
  std::vector<double> m;
};
[[nodiscard]] Belief vacuous(const Frame&);
/// Named masses; the rest is ignorance. Throws std::invalid_argument for unknown sets, negative masses, a sum above 1.
[[nodiscard]] Belief make_belief(const Frame&, std::initializer_list<std::pair<std::string_view, double>>);

struct Fused {
  Belief belief;
  double conflict = 0;          ///< product mass on the empty set
  bool total_conflict = false;  ///< Dempster had nothing to divide by and answers the vacuous belief
};

/// All sources together, by definition (Smarandache & Dezert 2006; PCR6: Martin & Osswald 2006; PCR5+, PCR6+: Dezert,
/// Dezert & Smarandache 2021). conjunctive and dsmc keep what falls on the empty set there; every other result is
/// divided by its own sum. dubois_prade and dsmh: a conflicting product goes to the union of its sets. murphy: the mean
/// with itself. Masses on the empty set, which only conjunctive and dsmc take, are dropped first by the others.
/// pcr2, pcr3 and pcr4 give a conflicting product back to those of its sets that contain no other of them, pcr5plus and
/// pcr6plus to those that do not contain all the others of their size or less, so that a vacuous source changes
/// nothing; pcr5 and pcr6, as printed, to all of them.
/// Throws std::invalid_argument for no source, beliefs of another size, masses that are negative or do not add up to 1
/// within 1e-6, a rule without a form on general frames (germ_pcr2, cautious, bayes, fuzzy), and for more than 10^8
/// tuples.
[[nodiscard]] Fused combine(Rule, const Frame&, std::span<const Belief> sources);

// What follows throws std::invalid_argument for a belief of another size than frame.subsets(); masses are not checked.

/// Shafer's discount: every mass times reliability, the rest to ignorance. std::invalid_argument for a reliability
/// outside [0, 1].
[[nodiscard]] Belief discount(const Frame&, const Belief&, double reliability);

[[nodiscard]] double belief(const Frame&, const Belief&, Subset);        ///< Bel: Σ m(X), X ⊆ A, not empty
[[nodiscard]] double plausibility(const Frame&, const Belief&, Subset);  ///< Pl: Σ m(X), X ∩ A not empty
[[nodiscard]] double commonality(const Frame&, const Belief&, Subset);   ///< q: Σ m(X), X ⊇ A
/// BetP (Smets 1990): every mass in equal shares to the parts of its set, over 1 − m(∅). On the free model the
/// generalised pignistic probability (Dezert, Smarandache & Daniel 2004).
[[nodiscard]] double pignistic(const Frame&, const Belief&, Subset);
/// DSmP_ε (Dezert & Smarandache 2008) of a set under Shafer's model: masses shared as m(part) + ε.
/// std::invalid_argument for the free model and unless ε > 0.
[[nodiscard]] double dsmp(const Frame&, const Belief&, Subset, double epsilon = 1e-3);
/// The hypothesis of largest BetP, ties to the lower index; frame.size() when that BetP is below `least`.
[[nodiscard]] std::size_t decide(const Frame&, const Belief&, double least = 0);

}  // namespace evigrid
