// SPDX-License-Identifier: Apache-2.0
// What can be asked of a cell's masses: the layers that render() draws, one by one, and decisions. Each formula stands
// beside its layer's name in engine/src/grid/layers.cpp and in docs/maths.md. Masses on empty ∩ occupied (c) count as
// m(∅): beliefs and probabilities are those of the rest, divided by its sum; the free model has layers of its own.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "evigrid/export.hpp"
#include "evigrid/types.hpp"

namespace EVIGRID_API evigrid {

enum class Layer : std::uint8_t {
  betp,               ///< pignistic probability of occupied
  bel,                ///< m(occupied): belief of occupied
  pl,                 ///< plausibility of occupied
  empty,              ///< m(empty)
  unknown,            ///< m(empty ∪ occupied)
  paradox,            ///< c: m(∅), m(empty ∩ occupied), or fuzzy's "both"; 0 where the rule leaves none
  ignorance,          ///< Pl − Bel
  commonality,        ///< q(occupied)
  plp,                ///< plausibility of occupied, normalised over both (plausibility transform)
  dsmp,               ///< DSmP_ε of occupied (Dezert & Smarandache 2008)
  free_betp,          ///< generalised pignistic of occupied on the free DSm model
  free_both,          ///< the same of empty ∩ occupied
  specificity,        ///< Σ m(A)/|A| (Yager 1983): 1 decided between the two, ½ unknown
  internal_conflict,  ///< −Σ m log2 Pl, bits: dissonance (Yager 1983)
  entropy,            ///< of betp, bits
  decision,           ///< of decide(): 1 occupied, 0 empty, ½ neither
  decision_betp,      ///< of decide_by_betp(): the same
  fuzzy_map,  ///< M = 1 − Ψ²(1 − Ω)(1 − ΨΩ)(1 − (1 − Ψ)(1 − Ω)) of e, o as memberships (Oriolo et al. 1997)
  conflict,       ///< running sum of the conflict k of every update; 0 where the map keeps none
  con,            ///< −Σ ln(1 − k), the weight of conflict (Shafer 1976), nats; 0 where the map keeps none
  last_conflict,  ///< k of the last update; 0 where the map keeps none
};
inline constexpr int kLayerCount = 21;
std::span<const Layer> all_layers() noexcept;
std::string_view name(Layer) noexcept;
std::optional<Layer> layer_from_name(std::string_view) noexcept;

/// Not checked.
struct ReadOutParams {
  double dsmp_epsilon = 1e-3;   ///< ≥ 0; dsmp
  double betp_at_least = 0.65;  ///< in [½, 1]; decision_betp: what is less sure either way is rejected
};

/// One read-out of masses; the three of a map's history (conflict, con, last_conflict) are 0 here.
[[nodiscard]] double value_of(Layer, const Mass&, const ReadOutParams& = {}) noexcept;

enum class Decision : std::uint8_t { unknown, empty, occupied };
/// m(unknown) < ½ and the larger of m(occupied), m(empty) (Li et al. 2014).
[[nodiscard]] Decision decide(const Mass&) noexcept;
/// By BetP, with rejection: occupied from `at_least` on, empty from 1 − at_least down.
[[nodiscard]] Decision decide_by_betp(const Mass&, double at_least) noexcept;

}  // namespace evigrid
