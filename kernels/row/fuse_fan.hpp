// SPDX-License-Identifier: Apache-2.0
// The loop over the micro-tiles of one tile for one fan of beams: every cell of the footprint finds its beam and is
// updated once. Beam and class come from float arithmetic with a margin; the few cells inside the margin are decided
// exactly in double (fan_exact.hpp), so that every table agrees on every cell.
#pragma once
#include "kernels/cell/mass.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/row/fuse_cone.hpp"

#include "kernels/row/fan_exact.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// model `beam` (ours): masses by class, falling linearly with distance.
template <class V>
EVIGRID_FN PlainSource<V> measure_beam(const FanReading& q, const V& cls, const V& d) {
  const V zero(0.0f), one(1.0f);
  const V f = neg_mul_add(d, V(q.fall), one);
  const V x = select(cls < V(1.5f), V(q.empty) * f, zero);
  const V y = select(cls > V(1.5f), V(q.occupied) * f, zero);
  return {x, y, one - (x + y)};
}

template <class State, bool kConflict>
void fuse_fan_planes(const TileArgs& a, const FanReading& q_in, Stats& stats) {
  using V = Lanes::V;
  const FanReading q = q_in;
  const std::size_t stride = static_cast<std::size_t>(a.planes) * kMicroCells;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float dxs[kMicrosPerSide][kMicroCells], dys[kMicrosPerSide][kMicroCells];
  for (int m = 0; m < kMicrosPerSide; ++m) {
    for (int i = 0; i < kMicroCells; ++i) {
      dxs[m][i] = a.x0 + static_cast<float>(4 * m + i % 4);
      dys[m][i] = a.y0 + static_cast<float>(4 * m + i / 4);
    }
  }
  alignas(64) float spare[kMostPlanes * kMicroCells] = {}, nowhere[kMicroCells];
  for (float& f : nowhere) f = 1e6f;
  const V zero(0.0f), one(1.0f), two(2.0f);
  V max_k(0.0f);
  for (int i = 0; i < a.empty_count; i += Lanes::kMicros) {  // the same masses, without asking for the beam
    float* cell[Lanes::kMicros];
    const float *px[Lanes::kMicros], *py[Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < a.empty_count;
      const int micro = a.empty_micros[there ? i + m : i];
      cell[m] = there ? a.cells + static_cast<std::size_t>(micro) * stride : spare;
      px[m] = there ? dxs[micro % kMicrosPerSide] : nowhere;
      py[m] = dys[micro / kMicrosPerSide];
    }
    const CellIo<State, kConflict> io(cell);
    for (int part = 0; part < kParts; ++part) {
      const V dx = Lanes::load(px, part), dy = Lanes::load(py, part);
      const V d = root(mul_add(dx, dx, dy * dy));
      io.fuse(part, measure_beam(q, one, d), d <= V(q.far), a.rule, stats, max_k);
    }
  }
  for (int i = 0; i < a.micro_count; i += Lanes::kMicros) {
    float* cell[Lanes::kMicros];
    const float *px[Lanes::kMicros], *py[Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < a.micro_count;
      const int micro = a.micros[there ? i + m : i];
      cell[m] = there ? a.cells + static_cast<std::size_t>(micro) * stride : spare;
      px[m] = there ? dxs[micro % kMicrosPerSide] : nowhere;
      py[m] = dys[micro / kMicrosPerSide];
    }
    const CellIo<State, kConflict> io(cell);
    for (int part = 0; part < kParts; ++part) {
      const V dx = Lanes::load(px, part), dy = Lanes::load(py, part);
      const V d = root(mul_add(dx, dx, dy * dy));
      const V slack = mul_add(d, V(1e-6f), V(1e-6f));
      const auto reach = both(d >= V(q.near) - slack, d <= V(q.far) + slack);
      if (!Lanes::any(reach)) continue;
      // Beam: index of the border below, with the fraction that says how sure it is.
      const V ahead = mul_add(V(q.mid_cos), dx, V(q.mid_sin) * dy),
              left = mul_add(V(q.mid_cos), dy, zero - V(q.mid_sin) * dx);
      const V t = mul_add(coarse_angle(ahead, left), V(q.beams_per_rad), V(q.half_beams));
      const V index = Lanes::floor(t), fraction = t - index;
      const V last(static_cast<float>(q.beams - 1));
      const auto near_fan = both(t >= V(-0.5f), index <= last + V(0.5f) + one);
      const auto on_beam = both(index >= zero, index <= last);
      const V beam = max_of(min_of(index, last), zero);
      const V r = Lanes::gather(q.range, beam);
      // Class: 1 empty, 2 occupied.
      const V past = d - r;
      const V to_empty = past + V(q.empty_margin), to_from = past + V(q.half_width), to_to = past - V(q.half_width);
      const auto is_empty = to_empty < zero;
      const auto is_occupied = both(to_from >= zero, to_to <= zero);
      const auto in_limits = both(d >= V(q.near), d <= V(q.far));
      V cls = select(both(in_limits, on_beam), select(is_empty, one, select(is_occupied, two, zero)), zero);
      // Too near a border for float?
      const V margin = V(q.angle_slack);
      const auto at_border = either(fraction <= margin, fraction >= one - margin);
      const auto within = [&](const V& x) EVIGRID_LAMBDA { return max_of(x, zero - x) <= slack; };
      const auto at_ring = either(either(within(to_empty), within(to_from)),
                                  either(within(to_to), either(within(d - V(q.near)), within(d - V(q.far)))));
      const auto unsure = both(both(reach, near_fan), either(at_border, at_ring));
      if (Lanes::any(unsure)) {
        std::uint64_t left_to_do = Lanes::bits(unsure);
        alignas(64) float c[Lanes::kLanes], x[Lanes::kLanes], y[Lanes::kLanes], b[Lanes::kLanes];
        Lanes::store_flat(c, cls);
        Lanes::store_flat(x, dx);
        Lanes::store_flat(y, dy);
        Lanes::store_flat(b, index);
        for (; left_to_do != 0; left_to_do &= left_to_do - 1) {
          const int lane = __builtin_ctzll(left_to_do);
          c[lane] = static_cast<float>(fan_class_exact(q_in, x[lane], y[lane], static_cast<int>(b[lane])));
        }
        cls = Lanes::load_flat(c);
      }
      const auto touched = cls > V(0.5f);
      if (!Lanes::any(touched)) continue;
      io.fuse(part, measure_beam(q, cls, d), touched, a.rule, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class State>
void fuse_fan(const TileArgs& a, const FanReading& q, Stats& stats) {
  if (a.micro_count + a.empty_count == 0) return;
  if (a.conflict_plane) {
    fuse_fan_planes<State, true>(a, q, stats);
  } else {
    fuse_fan_planes<State, false>(a, q, stats);
  }
}

EVIGRID_CELL_END
