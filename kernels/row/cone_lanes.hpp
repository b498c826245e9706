// SPDX-License-Identifier: Apache-2.0
// On which side of a cone's two edges a cell centre lies: the products with the edges' normals, exact up to one
// rounding, at three additions an edge. A product is that of the micro-tile's first cell, computed in double once for
// the whole micro-tile, plus what the cell's place in it adds, which is the same for every micro-tile of a cone. Both
// are split at 2^-20. On the lattice of docs/maths.md both low parts and their sum are exact, and so is the sum of the
// high parts below 8 cells: only the last addition rounds, so the sign is right and a tie is exactly zero. Farther away
// the first cell's high part is rounded too: 2^-24 of a product that is nowhere near zero.
#pragma once
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

EVIGRID_FN void split_product(double n, float& high, float& low) {
  constexpr double kMagic = 6442450944.0;  // 1.5 · 2^32: its last place is 2^-20
  const double h = (n + kMagic) - kMagic;
  high = static_cast<float>(h);
  low = static_cast<float>(n - h);
}

/// What the sixteen cells of a micro-tile add to its first one.
struct ConeLanes {
  alignas(64) float column[kMicroCells], row[kMicroCells];
  alignas(64) float column_twice[kMicroCells], row_twice[kMicroCells], square[kMicroCells];
  alignas(64) float left_high[kMicroCells], left_low[kMicroCells], right_high[kMicroCells], right_low[kMicroCells];

  ConeLanes() = default;
  explicit ConeLanes(const ConeReading& q) {
    for (int i = 0; i < kMicroCells; ++i) set(q, i, i);
  }
  /// Cell i of the sixteen, at place `at`.
  EVIGRID_FN void set(const ConeReading& q, int at, int i) {
    const int x = i & 3, y = i >> 2;
    column[at] = static_cast<float>(x);
    row[at] = static_cast<float>(y);
    column_twice[at] = static_cast<float>(2 * x);
    row_twice[at] = static_cast<float>(2 * y);
    square[at] = static_cast<float>(x * x + y * y);
    split_product(static_cast<double>(q.ly) * x - static_cast<double>(q.lx) * y, left_high[at], left_low[at]);
    split_product(static_cast<double>(q.rx) * y - static_cast<double>(q.ry) * x, right_high[at], right_low[at]);
  }
};

/// The products of the first cells of some micro-tiles; what is missing in the last step lies outside.
struct FirstCells {
  static constexpr int kMost = 64;
  alignas(64) float left_high[kMost], left_low[kMost], right_high[kMost], right_low[kMost];
  alignas(64) float excess[kMost];  // d² − T² of the model's own ring

  /// What it asks of a reading: a copy, for no store into the arrays can change it.
  struct Edges {
    double lx, ly, rx, ry, ring;
    EVIGRID_FN explicit Edges(const ConeReading& q)
        : lx(q.lx),
          ly(q.ly),
          rx(q.rx),
          ry(q.ry),
          ring(static_cast<double>(q.ring[kEdge].hi) + static_cast<double>(q.ring[kEdge].lo)) {}
  };
  template <bool kExcess>
  EVIGRID_FN void set(const Edges& e, float x, float y, int at) {
    const double dx = x, dy = y;
    split_product(e.ly * dx - e.lx * dy, left_high[at], left_low[at]);
    split_product(e.rx * dy - e.ry * dx, right_high[at], right_low[at]);
    if constexpr (kExcess) excess[at] = static_cast<float>(dx * dx + dy * dy - e.ring);
  }
  /// x and y are readable up to the next multiple of kAtOnce: whole vectors, without a rest to be counted.
  static constexpr int kAtOnce = 8;
  template <bool kExcess>
  void fill(const ConeReading& q, const float* x, const float* y, int count) {
    static_assert(kMost % kAtOnce == 0);
    const Edges e(q);
    for (int i = 0; i < count; i += kAtOnce) {
      for (int j = i; j < i + kAtOnce; ++j) set<kExcess>(e, x[j], y[j], j);
    }
    for (int i = count; i % Lanes::kMicros != 0; ++i) {
      left_high[i] = right_high[i] = -1e6f;
      left_low[i] = right_low[i] = excess[i] = 0;
    }
  }
};

EVIGRID_CELL_END
