// SPDX-License-Identifier: Apache-2.0
// The micro-tiles that a cone may touch, found for many bands of four rows at a time, and which of them lie in its
// zones (kernel_table.hpp). Conservative with a padding far above the rounding here: the kernel decides every cell.
#pragma once
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

/// An edge as bounds of dx = slope·dy + offset: one of the two is out of reach, both where the edge runs along the
/// rows, which then limits dy alone.
struct EdgeBound {
  float lower_slope = 0, lower = -1e9f, upper_slope = 0, upper = 1e9f;
  float row = 0;  // along the rows: row·dy ≥ 0

  /// Of n·(dx, dy) ≥ 0.
  EdgeBound(float nx, float ny) {
    if (nx > 1e-6f) {
      lower_slope = -ny / nx, lower = 0;
    } else if (nx < -1e-6f) {
      upper_slope = -ny / nx, upper = 0;
    } else {
      row = ny;
    }
  }
};

inline void cone_bands(const ConeReading& q, float x0, float y0, ConeBands& out) {
  using V = Lanes::V;
  const EdgeBound edges[2] = {EdgeBound(q.ly, -q.lx), EdgeBound(-q.ry, q.rx)};
  const float pad = 0.004f + 4e-6f * q.outer;
  const V zero(0.0f), padding(pad), quarter(0.25f), far_off(1e9f);
  const V outer(q.outer + pad), within(q.within_radius), free(q.free_radius), inner(q.inner + pad);
  const auto within_2 = q.within_radius > 0 ? within * within : zero - far_off;
  const auto free_2 = q.free_radius > 0 ? free * free : zero - far_off;
  const V beyond(q.outer + 16.0f);
  const bool to_the_right = q.lx + q.rx > 0;
  alignas(64) float index[Lanes::kLanes];
  for (int i = 0; i < Lanes::kLanes; ++i) index[i] = static_cast<float>(4 * i);
  const V steps = Lanes::load_flat(index);
  for (int band = 0; band < out.count; band += Lanes::kLanes) {
    const V low = V(y0 + static_cast<float>(4 * band)) + steps, high = low + V(3.0f);
    const V near = max_of(max_of(low, zero - high), zero), far = max_of(zero - low, high);
    const V ya = low - padding, yb = high + padding;
    // Columns of cells that may be touched: lo ≤ dx ≤ hi.
    const V nearest = max_of(near - padding, zero);
    V hi = root(max_of(neg_mul_add(nearest, nearest, outer * outer), zero)), lo = zero - hi;
    hi = select(nearest > outer, zero - far_off, hi);
    for (const EdgeBound& e : edges) {
      const V a = V(e.lower_slope) * ya, b = V(e.lower_slope) * yb, c = V(e.upper_slope) * ya,
              d = V(e.upper_slope) * yb;
      lo = max_of(lo, min_of(a, b) + V(e.lower));
      hi = min_of(hi, max_of(c, d) + V(e.upper));
      hi = select(max_of(V(e.row) * ya, V(e.row) * yb) < zero - padding, zero - far_off, hi);
    }
    lo = min_of(lo, beyond), hi = max_of(hi, zero - beyond);  // whole numbers that an int holds
    const V origin(x0);
    const auto first = [&](const V& x) EVIGRID_LAMBDA { return zero - Lanes::floor((origin - x) * quarter); };
    const auto end = [&](const V& x) EVIGRID_LAMBDA { return Lanes::floor((x - origin) * quarter) + V(1.0f); };
    V cut[ConeBands::kCuts];
    cut[0] = first((lo - padding) - V(3.0f));
    cut[5] = max_of(end(hi + padding), cut[0]);
    // Columns whose four cells all lie inside a disc.
    const auto disc = [&](const V& r2, int a, int b) EVIGRID_LAMBDA {
      const V left = neg_mul_add(far, far, r2), half = select(left > zero, root(max_of(left, zero)), zero - far_off);
      cut[a] = first(zero - half);
      cut[b] = end(half - V(3.0f));
    };
    disc(within_2, 1, 4);
    disc(free_2, 2, 3);
    // The ring about the apex is for the general zone; the cone's wider part lies beyond it.
    const V left = neg_mul_add(nearest, nearest, inner * inner), half = root(max_of(left, zero));
    if (to_the_right) {
      cut[1] = select(left >= zero, max_of(cut[1], end(half + padding)), cut[1]);
    } else {
      cut[4] = select(left >= zero, min_of(cut[4], first((zero - half) - (padding + V(3.0f)))), cut[4]);
    }
    const auto between = [&](int i, int a, int b) EVIGRID_LAMBDA { cut[i] = max_of(min_of(cut[i], cut[b]), cut[a]); };
    between(1, 0, 5);
    between(4, 1, 5);
    between(2, 1, 4);
    between(3, 2, 4);
    for (int c = 0; c < ConeBands::kCuts; ++c) Lanes::store_flat(out.cut + c * out.capacity + band, cut[c]);
  }
}

EVIGRID_CELL_END
