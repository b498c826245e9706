// SPDX-License-Identifier: Apache-2.0
// The masses that a state means, micro-tile by micro-tile.
#pragma once
#include "kernels/cell/state.hpp"

#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

template <class State>
void read_out(const float* cells, int planes, int micros, float* out) {
  using V = Lanes::V;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1, kOut = 4;
  alignas(64) float spare[kOut * kMicroCells] = {};
  const auto all = V(0.0f) >= V(0.0f);
  for (int i = 0; i < micros; i += Lanes::kMicros) {
    const float* from[State::kPlanes][Lanes::kMicros];
    float* to[kOut][Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < micros;
      const std::size_t micro = static_cast<std::size_t>(there ? i + m : i) * kMicroCells;
      for (int p = 0; p < State::kPlanes; ++p) {
        from[p][m] = cells + micro * static_cast<std::size_t>(planes) + static_cast<std::size_t>(p) * kMicroCells;
      }
      for (int p = 0; p < kOut; ++p) to[p][m] = (there ? out + micro * kOut : spare) + p * kMicroCells;
    }
    for (int part = 0; part < kParts; ++part) {
      V plane[State::kPlanes];
      for (int p = 0; p < State::kPlanes; ++p) plane[p] = Lanes::load(from[p], part);
      const Masses<V> r = State::read(plane);
      Lanes::store(to[0], part, all, r.e);
      Lanes::store(to[1], part, all, r.o);
      Lanes::store(to[2], part, all, r.u);
      Lanes::store(to[3], part, all, r.c);
    }
  }
}

EVIGRID_CELL_END
