// SPDX-License-Identifier: Apache-2.0
// fuse_cone.hpp cut in two, for tests: masses of a cone to memory, and masses from memory into the map. Every
// micro-tile is looked at cell by cell, as of the general zone.
#pragma once
#include "kernels/row/fuse_cone.hpp"

EVIGRID_CELL_BEGIN

template <Paradox kParadox, class Model>
using SourceOf = decltype(source_of<kParadox, Model, kRim>(ConeReading{}, Polar<Lanes::V>{}));

template <Paradox kParadox, class Model>
void measure_cone(const ConeArgs& a, const ConeReading& q, Measured& out) {
  using V = Lanes::V;
  const ZoneMicros& z = a.zone[kRim];
  const ConeLanes lanes(q);
  FirstCells first;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  constexpr int kRoom = FirstCells::kAtOnce;  // its lists need not be readable beyond their end
  static_assert(kRoom >= Lanes::kMicros);
  alignas(64) float x[kRoom], y[kRoom];
  for (int i = 0; i < z.count; i += Lanes::kMicros) {
    const int n = z.count - i < Lanes::kMicros ? z.count - i : Lanes::kMicros;
    for (int m = 0; m < kRoom; ++m) {
      x[m] = m < n ? z.x[i + m] : 1e6f;
      y[m] = m < n ? z.y[i + m] : 1e6f;
    }
    first.fill<kAsksExcess<Model>>(q, x, y, n);
    std::uint64_t bits = 0;
    for (int part = 0; part < kParts; ++part) {
      Polar<V> at;
      const auto inside = locate<kRim, kAsksExcess<Model>>(q, lanes, first, x, y, 0, part, at);
      const Parts<V> s = widen(source_of<kParadox, Model, kRim>(q, at));
      alignas(64) float masses[Measured::kParts][Lanes::kLanes];
      for (int p = 0; p < Measured::kParts; ++p) {
        Lanes::store_flat(masses[p], s.part[p]);
        for (int lane = 0; lane < Lanes::kLanes && lane < n * kMicroCells; ++lane) {
          out.part[p][i * kMicroCells + (kParts > 1 ? part : lane)] = masses[p][lane];
        }
      }
      bits |= Lanes::bits(inside) << (kParts > 1 ? part : 0);
    }
    for (int m = 0; m < n; ++m) out.inside[i + m] = static_cast<std::uint16_t>(bits >> (16 * m));
  }
}

template <class State, class Kind, bool kConflict>
void combine_measured_planes(const ConeArgs& a, const Measured& in, Stats& stats) {
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  const ZoneMicros& z = a.zone[kRim];
  alignas(64) float spare[kMostPlanes * kMicroCells] = {}, none[kMicroCells] = {};
  Lanes::V max_k(0.0f);
  for (int i = 0; i < z.count; i += Lanes::kMicros) {
    const ConeStep step(z, i, spare);
    alignas(64) float flag[Lanes::kMicros][kMicroCells];
    const float* source[Measured::kParts + 1][Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < z.count;
      for (int p = 0; p < Measured::kParts; ++p) source[p][m] = there ? in.part[p] + (i + m) * kMicroCells : none;
      for (int c = 0; c < kMicroCells; ++c) flag[m][c] = there && (in.inside[i + m] >> c & 1) != 0 ? 1.0f : 0.0f;
      source[Measured::kParts][m] = flag[m];
    }
    const CellIo<State, kConflict> io(step.cell);
    for (int part = 0; part < kParts; ++part) {
      const auto inside = Lanes::load(source[Measured::kParts], part) > Lanes::V(0.5f);
      if (!Lanes::any(inside)) continue;
      Parts<Lanes::V> s;
      for (int p = 0; p < Measured::kParts; ++p) s.part[p] = Lanes::load(source[p], part);
      io.fuse(part, narrow<Kind>(s), inside, a.rule, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class State, class Kind>
void combine_measured(const ConeArgs& a, const Measured& in, Stats& stats) {
  if (a.conflict_plane) {
    combine_measured_planes<State, Kind, true>(a, in, stats);
  } else {
    combine_measured_planes<State, Kind, false>(a, in, stats);
  }
}

EVIGRID_CELL_END
