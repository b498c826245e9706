// SPDX-License-Identifier: Apache-2.0
// Forgetting by time, lazily: a cell's masses are those of its stamp, in nanoseconds, and age by exp(−Δt/τ) when a
// reading comes to it or when it is read; reading never writes back. Three planes behind the others hold the stamp, as
// the bits of an int64 in two words, and τ of the sensor that spoke last. The tables' kernels know nothing of it: a
// cell is aged before they fuse and put back as it was when they had nothing to say to it.
#pragma once
#include <cstdint>
#include <vector>

#include "grid/tile_store.hpp"

namespace evigrid {

/// When a cell last heard something, and how fast that is forgotten.
struct CellAge {
  std::int64_t stamp_ns = 0;
  float tau_s = 0;  ///< 0: nothing was ever heard
};

/// τ of a reading: its sensor's own where it has one (`own_s` > 0), else the map's.
inline float tau_of(double own_s, const MapParams& p) noexcept {
  return static_cast<float>(own_s > 0 ? own_s : p.decay_s);
}

/// The masses of `micros` micro-tiles, one after the other, as they are at `now_ns`: in place, ages untouched. Time
/// that runs backwards changes nothing.
void age_masses(const CellLayout&, int planes, std::int64_t now_ns, float* cells, int micros) noexcept;

/// Of one cell, given where its first plane is, in a layout that keeps ages.
CellAge age_of(const CellLayout&, const float* cell) noexcept;
void set_age(const CellLayout&, float* cell, const CellAge&) noexcept;

/// Of one worker, for one reading at a time: hold() the micro-tiles that it may touch, age() them, let the kernel fuse
/// it, settle().
class DecayedUpdate {
 public:
  void hold(float* micro) { micros_.push_back(micro); }
  void age(const TileStore&, std::int64_t now_ns);
  /// Cells that the reading changed take its stamp, unless theirs is later, and its τ; the others become again what
  /// they were before age().
  void settle(const TileStore&, const CellAge& reading) noexcept;

 private:
  struct Masses {
    float mass[kMostMassPlanes * kernels::kMicroCells];
  };
  std::vector<float*> micros_;
  std::vector<Masses> before_, aged_;
};

}  // namespace evigrid
