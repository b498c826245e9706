// SPDX-License-Identifier: Apache-2.0
// All that the engine knows of the kernels: plain pointers, chosen once per map. A tile is 64 × 64 cells in 16 × 16
// micro-tiles of 4 × 4 cells (row-major, both); a micro-tile holds its planes side by side: 16 e, 16 o, 16 u and, where
// the map keeps it, 16 sums of conflict. 64-byte aligned. Rules whose state is not (e, o, u) have other planes
// (kernels/cell/state.hpp); read_out gives their masses.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernels/row/compile_reading.hpp"

namespace evigrid::kernels {

inline constexpr int kTileSide = 64, kMicroSide = 4, kMicrosPerSide = 16, kMicrosPerTile = 256, kMicroCells = 16;
/// Rules as kernels; where rules coincide on this frame one kernel serves (engine/src/rule_kernels.cpp). The first
/// kRules run in maps, all in the batch.
enum RuleKernel : int {
  kDempster,
  kPcr2,
  kPcr5,
  kGermPcr2,
  kYager,
  kDsmh,
  kPcr1,
  kPcr4,
  kConjunctive,
  kCautious,
  kMurphy,
  kBayes,
  kFuzzy,
  kDempsterLog,
  kRules,
  kDisjunctive = kRules,
  kBatchRules
};
inline constexpr int kMostPlanes = 8;  // of one cell

struct Stats {
  std::uint64_t cells = 0;            // updates
  std::uint64_t total_conflicts = 0;  // answered by policy
  float max_conflict = 0;
};

/// What a rule does with a source's mass on empty ∩ occupied: gives it back to both, drops it, or takes it in.
enum Paradox : int { kGivenBack, kDropped, kConsumed };

/// Parts of a cone's micro-tiles, by what all their cells are known to be beforehand. A shortcut only: the general
/// part may hold any micro-tile, and no bit of the map depends on where one is listed.
enum ConeZone : int {
  kFree,    // within free_radius: certain to be empty, before the discount
  kWithin,  // within within_radius: between the rings, so that only the two edges are left to be tested
  kRim,     // anything
  kConeZones
};

/// The micro-tiles of one zone: where their cells lie, and the offset of their first cell centre from the apex, exact.
/// All three are readable for kConeAhead entries more: the cells of what comes next are fetched ahead, and offsets are
/// taken by whole vectors.
struct ZoneMicros {
  float* const* cells = nullptr;
  const float *x = nullptr, *y = nullptr;
  int count = 0;
};
inline constexpr int kConeAhead = 24;

/// What some rules ask of the map beside the cell and the source.
struct RuleArgs {
  float sign = 1;              // −1 takes a reading back, from states that are sums
  float unknown_share = 0.5f;  // bayes: how much of m(unknown) each likelihood gets, ½ for BetP, 1 for PlP
  float least_log_odds = -6.9f, most_log_odds = 6.9f;  // bayes
  bool con = false, last = false;  // planes behind the sum of conflict: Con, and k of the last update
};

/// One reading on micro-tiles of any number of tiles.
struct ConeArgs {
  ZoneMicros zone[kConeZones];
  int planes = 3;               // of a cell, all of them
  bool conflict_plane = false;  // add k to the plane behind the state's
  RuleArgs rule{};
};

/// The micro-tiles of a cone, four rows of cells at a time: in a band, columns cut[0] … cut[5] (whole numbers) part
/// rim, within, free, within, rim. Column and band 0 begin at the offset (x0, y0) from the apex.
struct ConeBands {
  static constexpr int kCuts = 6;
  int count = 0, capacity = 0;  // capacity: a multiple of 64
  float* cut = nullptr;         // cut[c · capacity + band]
};

/// The same of one band, in whole micro-tiles; six are used.
struct ConeCuts {
  std::int32_t column[8];
};

/// One tile for one cone.
struct ConeTile {
  float* cells = nullptr;
  int step = 0;                          // floats in a micro-tile
  int first_row = 0, end_row = 0;        // those of the tile's rows of micro-tiles that have a band
  int first_band = 0, first_column = 0;  // of the tile, counted as the bands count
  float x0 = 0, y0 = 0;                  // offset of the tile's first cell centre from the apex, exact
};
/// Where the micro-tiles of a zone are to be written: room for kMicrosPerTile + kListAtOnce.
struct ListedMicros {
  float** cells = nullptr;
  float *x = nullptr, *y = nullptr;
  int count = 0;  // the answer
};
inline constexpr int kListAtOnce = 16;

/// The micro-tiles of a tile for one fan: those with nothing but empty cells, those to be looked at cell by cell, and
/// of the latter those near the apex or behind the fan, whose cells find their beams by an angle of their own. Numbers
/// of micro-tiles are floats here, as the lanes write them. Room for whole packs behind each list.
struct FanMicros {
  static constexpr int kRoom = kMicrosPerTile + 64;
  int empty_count = 0, edge_count = 0, near_count = 0;  // edge_count: with the near ones
  alignas(64) float empty[kRoom], edge[kRoom], near[kRoom];
  // Of the edge micro-tiles that are not near: direction of the centre, its place among the beams, and the lowest beam
  // that any of its cells can have.
  alignas(64) float turn_x[kRoom], turn_y[kRoom], place[kRoom], lowest[kRoom];
};

/// One fan on one tile.
struct TileArgs {
  float* cells = nullptr;
  int planes = 3;               // of a cell, all of them
  bool conflict_plane = false;  // add k to the plane behind the state's
  RuleArgs rule{};
  float x0 = 0, y0 = 0;  // offset of the tile's first cell centre from the apex, exact
  const FanMicros* fan = nullptr;
};

/// Masses of one reading on the micro-tiles of its general zone, in their order, kept apart from the map: the unfused
/// path.
struct Measured {
  static constexpr int kParts = 6;
  alignas(64) float part[kParts][4096];  // x, y, v, z, s and what else a source knows (Pack in cell/mass.hpp)
  std::uint16_t inside[256];
};

/// How masses become a cost (engine/src/grid/costs.cpp): BetP between `free_below` and `lethal_above` is 1 + the nearest
/// whole number to slope · (BetP − free_below).
struct CostArgs {
  float free_below = 0, lethal_above = 0, max_unknown = 0, slope = 0;
  float none = 0, lethal = 0;  // costs, whole numbers: no information; occupied
};

struct DensePlanes {
  const float *ae, *ao, *au, *be, *bo, *bu;
  float *ce, *co, *cu, *k;  // k may be null
  float* cc = nullptr;      // mass on empty ∩ occupied, of the rules that leave one; may be null
};

/// Masses at 16 bits: e and o in steps of 1/65535, the unknown is the rest. Not of rules that leave a mass on
/// empty ∩ occupied, but for fuzzy, whose operands need no unknown.
struct Dense16Planes {
  const std::uint16_t *ae, *ao, *be, *bo;
  std::uint16_t *ce, *co;
  float* k;  // may be null
};

/// DensePlanes in double, with the operands' masses on empty ∩ occupied (null: none).
struct DoublePlanes {
  const double *ae, *ao, *au, *ac, *be, *bo, *bu, *bc;
  double *ce, *co, *cu, *cc, *k;  // cc and k may be null
};

struct KernelTable {
  std::string_view name;
  int lanes;  // floats in one vector
  void (*cone_bands)(const ConeReading&, float x0, float y0, ConeBands&);
  /// The micro-tiles of one tile, by zone, none twice. Answers which of the tile's 8 × 8 squares of 2 × 2 micro-tiles
  /// they lie in, row-major from the lowest bit.
  std::uint64_t (*list_cone)(const ConeCuts* bands, const ConeTile&, ListedMicros* zones);
  void (*fuse_cone[kRules][kConeModels])(const ConeArgs&, const ConeReading&, Stats&);
  void (*compile_fan)(const FanType&, const SensorPose&, Fan&);
  void (*select_fan)(const FanReading&, float x0, float y0, FanMicros&);  // (x0, y0) as in TileArgs
  void (*fuse_fan[kRules])(const TileArgs&, const FanReading&, Stats&);
  void (*measure_cone[kRules][kConeModels])(const ConeArgs&, const ConeReading&, Measured&);
  void (*combine_measured[kRules][kConeModels])(const ConeArgs&, const Measured&, Stats&);
  /// Masses of `micros` micro-tiles, one after the other from `cells` on: 16 e, 16 o, 16 u, 16 c each, to `out`; both
  /// 64-byte aligned.
  void (*read_out[kRules])(const float* cells, int planes, int micros, float* out);
  /// Costs of micro-tiles beside each other, whose first planes are e, o and u, without c: four rows of 4 · micros
  /// bytes, `stride` apart.
  void (*render_costs)(const CostArgs&, const float* cells, int planes, int micros, std::uint8_t* out,
                       std::ptrdiff_t stride);
  std::uint64_t (*dense[kBatchRules])(const DensePlanes&, std::size_t begin, std::size_t end);
  std::uint64_t (*dense16[kBatchRules])(const Dense16Planes&, std::size_t begin, std::size_t end);
};

/// One point of a cone, by the scalar functions. Arguments as Polar (cells).
struct PointMass {
  float x, y, v, z, s;
};
PointMass measure_point(int cone_model, const ConeReading&, float nl, float nr, float d2, float edge, float outer);

/// The dense combination in double, scalar. Answers how many pairs were in total conflict.
std::uint64_t dense_double(int rule, const DoublePlanes&, std::size_t begin, std::size_t end);

const KernelTable& scalar_table() noexcept;
/// By name: "scalar", "avx2", "avx512", "auto" (the widest that can run); nullptr when it cannot run here.
const KernelTable* find_table(std::string_view name) noexcept;

}  // namespace evigrid::kernels
