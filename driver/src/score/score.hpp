// SPDX-License-Identifier: Apache-2.0
// How well a map agrees with the world it was made in. Three classes on either side: the map's cells are decided as the
// 2014 paper decides its final map (u < 0.5 and o > e: occupied; u < 0.5 and e > o: empty; else unknown), the true ones
// are free, surface (a wall passes through the cell) or solid (behind walls, where no sensor can see).
#pragma once
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "evigrid/scenes/truth.hpp"
#include "out/layers.hpp"

namespace evigrid::driver {

enum class Decision : std::uint8_t { unknown, empty, occupied };
[[nodiscard]] Decision decide(float e, float o, float u) noexcept;

/// A map laid over a truth: what each cell of the smallest box around both holds. Row 0 has the smallest y.
struct Overlay {
  CellRect rect{};
  std::vector<scenes::TruthCell> truth;  ///< outside the truth's grid: as on its margin
  std::vector<Decision> map;             ///< outside the map: unknown
};
[[nodiscard]] Overlay overlay(const Layers& map, const scenes::TruthGrid& truth);
/// Whether cell i is a surface with a free cell among its 8 neighbours: one that a sensor could see.
[[nodiscard]] bool visible_wall(const Overlay& overlay, std::size_t i);

/// Shares are NaN when there is nothing to divide by. "near" forgives one cell (8 neighbours) of misplacement: a cell
/// called occupied is right when a wall is within one cell; a wall is found when a cell within one cell of it is called
/// occupied, and then cells of it called empty are no mistake.
struct Agreement {
  double precision = 0;      ///< of the cells called occupied: share that is surface or solid
  double recall = 0;         ///< of the surface cells that border free space: share called occupied
  double mistaken_rate = 0;  ///< of the decided cells: called occupied where free, or empty where surface or solid
};

struct Score {
  std::array<std::array<std::uint64_t, 3>, 3> confusion{};  ///< [TruthCell][Decision], in cells
  Agreement strict, near;
  double known_share = 0;         ///< of the free cells: share decided
  double out_of_sight_share = 0;  ///< of the cells called occupied: share in solid, which no sensor can have seen
  // Means over the free and the surface cells, also those that the map does not know.
  double log_loss_betp = 0, log_loss_plp = 0;  ///< nats; p is kept within [1e-6, 1 − 1e-6]
  double brier_betp = 0, brier_plp = 0;
  double map_score = 0;  ///< Martin & Moravec 1996: Σ 1 + log2(p·t + (1 − p)(1 − t)) a cell; 0 for all unknown, 1 perfect
  double entropy = 0;    ///< of BetP, bits
  double ignorance = 0;  ///< m(unknown)
};

[[nodiscard]] Score score(const Layers& map, const scenes::TruthGrid& truth);
/// The same where the overlay of both is at hand.
[[nodiscard]] Score score(const Layers& map, const scenes::TruthGrid& truth, const Overlay& overlay);
[[nodiscard]] nlohmann::ordered_json to_json(const Score& score);

}  // namespace evigrid::driver
