// SPDX-License-Identifier: Apache-2.0
// fuse_cone.hpp cut in two, for tests: masses of a cone to memory, and masses from memory into the map. Every
// micro-tile is looked at cell by cell, as of the general zone.
#pragma once
#include "kernels/row/fuse_cone.hpp"

EVIGRID_CELL_BEGIN

/// A source as memory holds it, and back: a plain one keeps its kind, so that both paths run the same functions.
template <class V>
EVIGRID_FN Source<V> widen(const Source<V>& m) {
  return m;
}
template <class V>
EVIGRID_FN Source<V> widen(const PlainSource<V>& m) {
  return {m.x, m.y, m.v, V(0.0f), V(1.0f)};
}
template <class Kind, class V>
EVIGRID_FN Kind narrow(const Source<V>& m) {
  if constexpr (requires(Kind k) { k.z; }) {
    return m;
  } else {
    return {m.x, m.y, m.v};
  }
}
template <Paradox kParadox, class Model>
using SourceOf = decltype(source_of<kParadox, Model, kRim>(ConeReading{}, Polar<Lanes::V>{}));

template <Paradox kParadox, class Model>
void measure_cone(const ConeArgs& a, const ConeReading& q, Measured& out) {
  using V = Lanes::V;
  const ZoneMicros& z = a.zone[kRim];
  const ConeLanes lanes(q);
  FirstCells first;
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  alignas(64) float x[Lanes::kMicros], y[Lanes::kMicros];
  for (int i = 0; i < z.count; i += Lanes::kMicros) {
    const int n = z.count - i < Lanes::kMicros ? z.count - i : Lanes::kMicros;
    first.fill<kAsksExcess<Model>>(q, z.x + i, z.y + i, n);
    for (int m = 0; m < Lanes::kMicros; ++m) {
      x[m] = m < n ? z.x[i + m] : 1e6f;
      y[m] = m < n ? z.y[i + m] : 1e6f;
    }
    std::uint64_t bits = 0;
    for (int part = 0; part < kParts; ++part) {
      Polar<V> at;
      const auto inside = locate<kRim, kAsksExcess<Model>>(q, lanes, first, x, y, 0, part, at);
      const Source<V> s = widen(source_of<kParadox, Model, kRim>(q, at));
      alignas(64) float masses[5][Lanes::kLanes];
      const V* const from[5] = {&s.x, &s.y, &s.v, &s.z, &s.s};
      float* const to[5] = {out.x, out.y, out.v, out.z, out.s};
      for (int p = 0; p < 5; ++p) {
        Lanes::store_flat(masses[p], *from[p]);
        for (int lane = 0; lane < Lanes::kLanes && lane < n * kMicroCells; ++lane) {
          to[p][i * kMicroCells + (kParts > 1 ? part : lane)] = masses[p][lane];
        }
      }
      bits |= Lanes::bits(inside) << (kParts > 1 ? part : 0);
    }
    for (int m = 0; m < n; ++m) out.inside[i + m] = static_cast<std::uint16_t>(bits >> (16 * m));
  }
}

template <class Rule, class Model, bool kConflict>
void combine_measured_planes(const ConeArgs& a, const Measured& in, Stats& stats) {
  constexpr int kParts = Lanes::kLanes < kMicroCells ? kMicroCells / Lanes::kLanes : 1;
  const ZoneMicros& z = a.zone[kRim];
  alignas(64) float spare[4 * kMicroCells] = {}, none[kMicroCells] = {};
  Lanes::V max_k(0.0f);
  for (int i = 0; i < z.count; i += Lanes::kMicros) {
    const ConeStep step(z, i, spare);
    alignas(64) float flag[Lanes::kMicros][kMicroCells];
    const float* source[6][Lanes::kMicros];
    for (int m = 0; m < Lanes::kMicros; ++m) {
      const bool there = i + m < z.count;
      const float* const planes[5] = {in.x, in.y, in.v, in.z, in.s};
      for (int p = 0; p < 5; ++p) source[p][m] = there ? planes[p] + (i + m) * kMicroCells : none;
      for (int c = 0; c < kMicroCells; ++c) flag[m][c] = there && (in.inside[i + m] >> c & 1) != 0 ? 1.0f : 0.0f;
      source[5][m] = flag[m];
    }
    const CellIo<kConflict> io(step.cell);
    for (int part = 0; part < kParts; ++part) {
      const auto inside = Lanes::load(source[5], part) > Lanes::V(0.5f);
      if (!Lanes::any(inside)) continue;
      const Source<Lanes::V> s{Lanes::load(source[0], part), Lanes::load(source[1], part), Lanes::load(source[2], part),
                               Lanes::load(source[3], part), Lanes::load(source[4], part)};
      io.template fuse<Rule>(part, narrow<SourceOf<paradox_of<Rule>(), Model>>(s), inside, stats, max_k);
    }
  }
  const float k = Lanes::reduce_max(max_k);
  if (k > stats.max_conflict) stats.max_conflict = k;
}

template <class Rule, class Model>
void combine_measured(const ConeArgs& a, const Measured& in, Stats& stats) {
  if (a.conflict_plane) {
    combine_measured_planes<Rule, Model, true>(a, in, stats);
  } else {
    combine_measured_planes<Rule, Model, false>(a, in, stats);
  }
}

EVIGRID_CELL_END
