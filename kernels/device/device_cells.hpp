// SPDX-License-Identifier: Apache-2.0
// What one thread of a device does: it owns one cell of a square of 16 × 16, keeps its planes in registers, and takes
// the readings of the square in their order. No two threads share a cell, so there is nothing to synchronise and the
// order of combination is that of the map. Bits are those of the tables: the text is the same.
#pragma once
#include "kernels/device/lane_device.hpp"
// After the lanes.
#include "kernels/cell/fade.hpp"
#include "kernels/cell/mass.hpp"
#include "kernels/cell/one_sided.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/state_sums.hpp"
#include "kernels/device/device.hpp"
#include "kernels/row/cone_cells.hpp"
#include "kernels/row/fan_cells.hpp"
#include "kernels/row/fan_class.hpp"

EVIGRID_CELL_BEGIN

/// What all readings of a batch share.
struct DeviceBatchArgs {
  int planes = 3;
  int age = -1;
  bool conflict_plane = false;
  RuleArgs rule{};
};

inline constexpr int kSquareSide = 16, kSquareCells = 256, kSquaresPerSide = 4, kSquaresPerTile = 16;

/// A square of a tile, cells counted from the tile's first.
struct Square16 {
  std::int64_t x = 0, y = 0;  // first cell of the map
  EVIGRID_FN Square16(const DeviceTile& tile, int square)
      : x(tile.x * kTileSide + square % kSquaresPerSide * kSquareSide),
        y(tile.y * kTileSide + square / kSquaresPerSide * kSquareSide) {}
};

/// Where a thread's cell lies: micro-tiles row by row, sixteen threads each.
struct Place {
  int micro_x, micro_y, cell;  // micro-tile of the square, cell of the micro-tile
  EVIGRID_FN explicit Place(int thread) : micro_x(thread / 16 % 4), micro_y(thread / 64), cell(thread % 16) {}
  /// Of its first plane among the tile's floats.
  EVIGRID_FN std::size_t offset(int square, int planes) const {
    const int x = square % kSquaresPerSide * 4 + micro_x, y = square / kSquaresPerSide * 4 + micro_y;
    return static_cast<std::size_t>((y * kMicrosPerSide + x) * planes) * kMicroCells + static_cast<std::size_t>(cell);
  }
};

/// Which of the tile's 8 × 8 blocks of cells holds the place.
EVIGRID_FN int block_of(int square, const Place& place) {
  return (square / kSquaresPerSide * 2 + place.micro_y / 2) * 8 + square % kSquaresPerSide * 2 + place.micro_x / 2;
}

/// Offset of a cell's centre from an apex at cell `index` plus `fraction`: exact on the lattice.
EVIGRID_FN float offset_from(std::int64_t cell, std::int64_t index, float fraction) {
  return static_cast<float>(static_cast<double>(cell - index) - static_cast<double>(fraction));
}

/// What KernelTable::render_costs makes of a cell (kernels/row/render_costs.hpp).
EVIGRID_FN std::uint8_t cost_of_cell(const CostArgs& c, float o, float u) {
  const float betp = o + 0.5f * u, between = (betp - c.free_below) * c.slope + 1.5f;
  const float cost = betp > c.lethal_above ? c.lethal : betp < c.free_below ? 0.0f : between;
  return static_cast<std::uint8_t>(static_cast<int>(u > c.max_unknown ? c.none : cost));
}
/// One micro-tile of a tile, as bytes in four rows of the tile's.
EVIGRID_FN void costs_of_micro(const CostArgs& c, const float* tile, int planes, int micro, std::uint8_t* out) {
  const float* const o = tile + (micro * planes + 1) * kMicroCells;
  std::uint8_t* const to = out + micro / kMicrosPerSide * kMicroSide * kTileSide + micro % kMicrosPerSide * kMicroSide;
  for (int cell = 0; cell < kMicroCells; ++cell)
    to[cell / kMicroSide * kTileSide + cell % kMicroSide] = cost_of_cell(c, o[cell], o[kMicroCells + cell]);
}

inline constexpr float kHalfDiagonal = 10.7f;  // of the cell centres of a square, with room for rounding

/// False only where no cell of the square can be in the cone.
EVIGRID_FN bool may_touch(const ConeReading& q, const Square16& at) {
  const float x = offset_from(at.x, q.i0, q.fx) + 7.5f, y = offset_from(at.y, q.j0, q.fy) + 7.5f;
  const float d = root(x * x + y * y), room = kHalfDiagonal + 1e-5f * d;
  return d <= q.outer + room && d >= q.inner - room && q.ly * x - q.lx * y >= -room && q.rx * -y + q.ry * x <= room;
}
/// False only where no cell of the square can be in the fan's reach.
EVIGRID_FN bool may_touch(const FanReading& q, const Square16& at) {
  const float x = offset_from(at.x, q.i0, q.fx) + 7.5f, y = offset_from(at.y, q.j0, q.fy) + 7.5f;
  const float d = root(x * x + y * y), room = kHalfDiagonal + 1e-5f * d;
  return d <= q.far + room && d >= q.near - room;
}

/// States whose conflict is an effort of its own, made only where a plane keeps it.
template <class State>
inline constexpr bool kConflictIsExtra = false;
template <>
inline constexpr bool kConflictIsExtra<LargerWeights> = true;
template <>
inline constexpr bool kConflictIsExtra<LogWeights> = true;
template <>
inline constexpr bool kConflictIsExtra<MeanCells> = true;
template <>
inline constexpr bool kConflictIsExtra<LogOdds> = true;

/// States that are masses, which time can discount.
template <class State>
inline constexpr bool kCanForget = RuleOfMasses<State>::kThere;
template <>
inline constexpr bool kCanForget<OpenCells> = true;

/// The age of a cell in maps that forget: aged before a reading is fused, put back where it had nothing to say.
template <class State, bool kForgets>
struct OwnAge {
  EVIGRID_FN void load(const float*, const DeviceBatchArgs&) {}
  EVIGRID_FN void store(float*, const DeviceBatchArgs&) const {}
  EVIGRID_FN void hears(const ReadingAge*, std::uint32_t) {}
  EVIGRID_FN void fade(float (&)[State::kPlanes]) {}
  EVIGRID_FN void settle(float (&)[State::kPlanes]) {}
};
template <class State>
struct OwnAge<State, true> {
  std::int64_t stamp_ns;
  float tau_s;
  ReadingAge heard;
  float before[State::kPlanes], aged[State::kPlanes];

  EVIGRID_FN void load(const float* p, const DeviceBatchArgs& a) {
    p += a.age * kMicroCells;
    const auto low = std::bit_cast<std::uint32_t>(p[0]), high = std::bit_cast<std::uint32_t>(p[kMicroCells]);
    stamp_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(high) << 32 | low);
    tau_s = p[2 * kMicroCells];
  }
  EVIGRID_FN void store(float* p, const DeviceBatchArgs& a) const {
    p += a.age * kMicroCells;
    const auto bits = static_cast<std::uint64_t>(stamp_ns);
    p[0] = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    p[kMicroCells] = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
    p[2 * kMicroCells] = tau_s;
  }
  EVIGRID_FN void hears(const ReadingAge* ages, std::uint32_t reading) { heard = ages[reading]; }
  EVIGRID_FN void fade(float (&plane)[State::kPlanes]) {
    for (int i = 0; i < State::kPlanes; ++i) before[i] = plane[i];
    if (const float share = share_left(stamp_ns, tau_s, heard.stamp_ns); share != 1.0f) {
      float given_up = 0, left = 0;
      for (int i = 0; i < State::kPlanes; ++i) {
        if (i != 2) keep_share(share, plane[i], given_up, left);
      }
      plane[2] = left == 0.0f ? 1.0f : plane[2] + given_up;
    }
    for (int i = 0; i < State::kPlanes; ++i) aged[i] = plane[i];
  }
  EVIGRID_FN void settle(float (&plane)[State::kPlanes]) {
    bool told = false;  // whether a bit changed
    for (int i = 0; i < State::kPlanes; ++i)
      told = told || std::bit_cast<std::uint32_t>(plane[i]) != std::bit_cast<std::uint32_t>(aged[i]);
    if (!told) {
      for (int i = 0; i < State::kPlanes; ++i) plane[i] = before[i];
      return;
    }
    stamp_ns = tau_s == 0.0f || heard.stamp_ns > stamp_ns ? heard.stamp_ns : stamp_ns;
    tau_s = heard.tau_s;
  }
};

/// One cell between its load and its store.
template <class StateOfCell, bool kForgets>
struct OwnCell {
  using State = StateOfCell;
  OwnAge<State, kForgets> age;
  float plane[State::kPlanes];
  float conflict = 0, con = 0, last = 0;
  float max_k = 0;
  std::uint32_t updates = 0, totals = 0;

  EVIGRID_FN void load(const float* p, const DeviceBatchArgs& a) {
    for (int i = 0; i < State::kPlanes; ++i) plane[i] = p[i * kMicroCells];
    age.load(p, a);
    if (!a.conflict_plane) return;
    p += State::kPlanes * kMicroCells;
    conflict = *p;
    if (a.rule.con) con = *(p += kMicroCells);
    if (a.rule.last) last = *(p += kMicroCells);
  }
  EVIGRID_FN void store(float* p, const DeviceBatchArgs& a) const {
    for (int i = 0; i < State::kPlanes; ++i) p[i * kMicroCells] = plane[i];
    age.store(p, a);
    if (!a.conflict_plane) return;
    p += State::kPlanes * kMicroCells;
    *p = conflict;
    if (a.rule.con) *(p += kMicroCells) = con;
    if (a.rule.last) *(p += kMicroCells) = last;
  }
  EVIGRID_FN void count(float k, const DeviceBatchArgs& a) {
    ++updates;
    max_k = max_of(max_k, k);
    if (!a.conflict_plane) return;
    conflict = conflict + k;
    if (a.rule.con) con = con + log_one_plus(k / max_of(1.0f - k, 1e-12f));
    last = k;
  }
  template <class S>
  EVIGRID_FN void fuse(const S& source, const DeviceBatchArgs& a) {
    age.fade(plane);
    const auto next = State::template update<true>(plane, source, a.rule);
    float k = next.k;
    if constexpr (kConflictIsExtra<State>) k = a.conflict_plane ? k : 0.0f;
    for (int i = 0; i < State::kPlanes; ++i) plane[i] = next.plane[i];
    age.settle(plane);
    if constexpr (State::kTotalPossible) totals += next.total ? 1u : 0u;
    count(k, a);
  }
};

/// False only where the cell at this offset from the apex is not in the cone: floats and a margin far above their
/// rounding. Most cells of a square are none of the cone's, and need no double then.
EVIGRID_FN bool may_lie_in(const ConeReading& q, float x, float y) {
  const float d2 = mul_add(x, x, y * y), room = mul_add(1e-5f, magnitude(x) + magnitude(y), 1e-2f);
  return mul_add(q.ly, x, -(q.lx * y)) >= -room && mul_add(q.rx, y, -(q.ry * x)) >= -room &&
         d2 <= (q.outer + room) * (q.outer + room) && (q.inner <= room || d2 >= (q.inner - room) * (q.inner - room));
}

template <class Model, class State, bool kForgets>
EVIGRID_FN void fuse_one(OwnCell<State, kForgets>& own, const ConeReading& q, const Square16& at, const Place& place,
                         const DeviceBatchArgs& a) {
  constexpr bool kExcess = kAsksExcess<Model>;
  constexpr Paradox kParadox = paradox_of<State>();
  const float x = offset_from(at.x + place.micro_x * kMicroSide, q.i0, q.fx),
              y = offset_from(at.y + place.micro_y * kMicroSide, q.j0, q.fy);
  if (!may_lie_in(q, x + Lanes::column(place.cell), y + Lanes::row(place.cell))) return;
  ConeLanes lanes;
  FirstCells first;
  lanes.set(q, 0, place.cell);
  first.template set<kExcess>(FirstCells::Edges(q), x, y, 0);
  Polar<float> polar;
  if (!locate<kRim, kExcess>(q, lanes, first, &x, &y, 0, 0, polar)) return;
  if constexpr (kTold<kParadox, Model>) {
    if (!q.contextual.used) return own.fuse(source_of<kParadox, Model, kRim>(q, polar), a);
  }
  own.fuse(source_of<kConsumed, Model, kRim>(q, polar), a);
}

template <class State, bool kForgets>
EVIGRID_FN void fuse_one(OwnCell<State, kForgets>& own, const FanReading& q, const Square16& at, const Place& place,
                         const DeviceBatchArgs& a) {
  const float dx = offset_from(at.x + place.micro_x * kMicroSide, q.i0, q.fx) + Lanes::column(place.cell),
              dy = offset_from(at.y + place.micro_y * kMicroSide, q.j0, q.fy) + Lanes::row(place.cell);
  const float d = root(mul_add(dx, dx, dy * dy));
  FanClasses c = classify_anywhere(q, dx, dy, d);
  if (c.unsure) {
    const int decided = fan_class(q, dx, dy, static_cast<int>(c.index));
    c.empty = decided == 1, c.occupied = decided == 2;
  }
  if (!c.empty && !c.occupied) return;
  if constexpr (RuleOfMasses<State>::kThere) {
    using Rule = typename RuleOfMasses<State>::type;
    const auto source = measure_beam(q, c.occupied ? q.occupied : q.empty, d);
    // An occupied cell is the mirror image of an empty one.
    const int e = c.occupied ? 1 : 0;
    own.age.fade(own.plane);
    const auto next = Rule::template combine<MapState>(
        Cell<float>{c.occupied ? own.plane[1] : own.plane[0], c.occupied ? own.plane[0] : own.plane[1], own.plane[2]},
        source);
    own.plane[0] = e == 1 ? next.cell.b : next.cell.a;
    own.plane[1] = e == 1 ? next.cell.a : next.cell.b;
    own.plane[2] = next.cell.u;
    own.age.settle(own.plane);
    if constexpr (Rule::kTotalPossible) own.totals += next.total ? 1u : 0u;
    own.count(next.k, a);
  } else {
    own.fuse(measure_beam_plain(q, c.occupied, d), a);
  }
}

EVIGRID_CELL_END
