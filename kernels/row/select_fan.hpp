// SPDX-License-Identifier: Apache-2.0
// Which micro-tiles of a tile a fan may touch, and which of them lie wholly in its empty part: squares of cells judged
// at once, first 8 × 8 cells, then 4 × 4, by the extreme ranges of the beams that can cover them. Every judgement is on
// the safe side; what is neither out nor wholly empty is left to the cell by cell test, so rounding here cannot change
// a map.
#pragma once
#include "kernels/cell/poly.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

struct Squares {
  Lanes::M out, empty;
  Lanes::M near;            // of neither: no window of beams
  Lanes::V turn_x, turn_y;  // direction of the centre
  Lanes::V place, low;      // of the centre among the beams; lowest beam of any cell
};

/// Squares of cells around (x, y), half diagonal `radius` between outermost cell centres.
EVIGRID_FN Squares judge_squares(const FanReading& q, const Lanes::V& x, const Lanes::V& y, float radius) {
  using V = Lanes::V;
  const V zero(0.0f), one(1.0f), last(static_cast<float>(q.beams - 1));
  const V d = root(mul_add(x, x, y * y));
  const V pad = mul_add(d, V(1e-5f), V(radius + 0.01f));
  const V per_d = one / max_of(d, V(1.5f * radius)), s = V(radius) * per_d;
  const V half = mul_add(V(0.3f) * s, s * s, s) + V(1e-5f);  // ≥ asin(s) for s ≤ 2/3
  const V ahead = mul_add(V(q.mid_cos), x, V(q.mid_sin) * y), left = neg_mul_add(V(q.mid_sin), x, V(q.mid_cos) * y);
  const V angle = coarse_angle(ahead, left), turned = magnitude(angle);
  const V t = mul_add(angle, V(q.beams_per_rad), V(q.half_beams)),
          h = mul_add(half, V(q.beams_per_rad), V(q.angle_slack));
  const V low = Lanes::floor(t - h), high = Lanes::floor(t + h);
  const auto on_fan = both(low >= zero, high <= last);
  const auto beside = turned - half > V(q.half_angle + 1e-4f);
  V from = max_of(low, zero), to = min_of(high, last);
  if (q.full_circle) {  // the table holds the turn twice: squares at the seam look one turn further
    const V turn(static_cast<float>(q.beams)), shift = select(low < zero, turn, zero);
    from = max_of(low + shift - one, zero);
    to = min_of(high + shift + one, turn + last);
  }
  const V width = max_of(to - from + one, one);
  from = min_of(from, last + (q.full_circle ? V(static_cast<float>(q.beams)) : zero));
  V row = zero, power = one;
  float step = 2;
  for (int l = 1; l < q.reach_levels; ++l, step *= 2) {
    const auto wide = width >= V(step);
    row = select(wide, V(static_cast<float>(l * q.reach_stride)), row);
    power = select(wide, V(step), power);
  }
  const V first = row + from, second = first + (width - power);
  V most, least, most_2, least_2;
  Lanes::gather_halves(q.reach, first, most, least);
  Lanes::gather_halves(q.reach, second, most_2, least_2);
  most = max_of(most, most_2) * V(q.reach_unit);
  least = min_of(least, least_2) * V(q.reach_unit);
  const auto apart = d >= V(1.5f * radius);                   // else the apex is in or near the square
  const auto known = both(apart, turned + half <= V(3.14f));  // else it lies across the line behind the fan's middle
  const auto past_near = d > V(q.near) + pad;
  Squares m;
  m.out = either(either(d > V(q.far) + pad, d + pad < V(q.near)),
                 either(both(apart, beside), both(known, d > most + (V(q.half_width) + pad))));
  m.empty = both(both(known, on_fan), both(least > d + (V(q.empty_margin) + pad), both(past_near, d + pad < V(q.far))));
  // A window needs the centre to be four radii off, for the arc sine of the turn from it, and few enough beams.
  const auto windowed = both(both(known, past_near), both(s <= V(0.25f), high - low < V(Lanes::kWindow)));
  m.near = select(windowed, zero, one) > V(0.5f);
  m.turn_x = x * per_d, m.turn_y = y * per_d;
  m.place = t;
  m.low = max_of(min_of(low, last + one), V(-static_cast<float>(Lanes::kWindow)));
  return m;
}

inline void select_fan(const FanReading& q, float x0, float y0, FanMicros& out) {
  constexpr int kNodes = 64;  // squares of 8 × 8 cells
  alignas(64) float x[kMicrosPerTile], y[kMicrosPerTile], asked[kMicrosPerTile];
  for (int i = 0; i < kNodes; ++i) {
    x[i] = x0 + 3.5f + static_cast<float>(8 * (i % 8));
    y[i] = y0 + 3.5f + static_cast<float>(8 * (i / 8));
  }
  std::uint64_t gone = 0, empty = 0;
  for (int i = 0; i < kNodes; i += Lanes::kLanes) {
    const Squares m = judge_squares(q, Lanes::load_flat(x + i), Lanes::load_flat(y + i), 4.95f);
    gone |= Lanes::bits(m.out) << i;
    empty |= Lanes::bits(m.empty) << i;
  }
  constexpr int kPart[4] = {0, 1, kMicrosPerSide, kMicrosPerSide + 1};  // micro-tiles of a node
  const auto micro_of = [](int node) { return 2 * (node / 8) * kMicrosPerSide + 2 * (node % 8); };
  empty &= ~gone;
  int empties = 0, edges = 0, nears = 0, count = 0;
  for (std::uint64_t left = empty; left != 0; left &= left - 1) {
    const int micro = micro_of(__builtin_ctzll(left));
    for (const int part : kPart) out.empty[empties++] = static_cast<float>(micro + part);
  }
  for (std::uint64_t left = ~(gone | empty); left != 0; left &= left - 1) {
    const int node = __builtin_ctzll(left), micro = micro_of(node);
    const float left_x = x0 + 1.5f + static_cast<float>(8 * (node % 8)),
                low_y = y0 + 1.5f + static_cast<float>(8 * (node / 8));
    for (int k = 0; k < 4; ++k, ++count) {
      asked[count] = static_cast<float>(micro + kPart[k]);
      x[count] = left_x + static_cast<float>(4 * (k % 2));
      y[count] = low_y + static_cast<float>(4 * (k / 2));
    }
  }
  for (int i = count; i % Lanes::kLanes != 0; ++i) x[i] = y[i] = 1e6f;  // out
  for (int i = 0; i < count; i += Lanes::kLanes) {
    const Squares m = judge_squares(q, Lanes::load_flat(x + i), Lanes::load_flat(y + i), 2.13f);
    const Lanes::V number = Lanes::load_flat(asked + i), zero(0.0f), one(1.0f);
    const Lanes::V kind = select(m.out, zero, select(m.empty, one, select(m.near, Lanes::V(3.0f), Lanes::V(2.0f))));
    const auto edge = both(kind > Lanes::V(1.5f), kind < Lanes::V(2.5f));
    empties += Lanes::append(out.empty + empties, both(kind > Lanes::V(0.5f), kind < Lanes::V(1.5f)), number);
    nears += Lanes::append(out.near + nears, kind > Lanes::V(2.5f), number);
    Lanes::append(out.turn_x + edges, edge, m.turn_x);
    Lanes::append(out.turn_y + edges, edge, m.turn_y);
    Lanes::append(out.place + edges, edge, m.place);
    Lanes::append(out.lowest + edges, edge, m.low);
    edges += Lanes::append(out.edge + edges, edge, number);
  }
  for (int i = edges; i < edges + Lanes::kMicros; ++i) {  // missing micro-tiles of the last step: any valid window
    out.turn_x[i] = out.turn_y[i] = out.lowest[i] = 0;
    out.place[i] = 0.5f;
  }
  out.empty_count = empties;
  out.edge_count = edges + nears;
  out.near_count = nears;
}

EVIGRID_CELL_END
