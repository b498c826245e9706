// SPDX-License-Identifier: Apache-2.0
// A grid whose cells are fused with one constant mass over a region at a time, by Smets' operator: boxes of beacons,
// and the free space between them and the platform. Cells go through the engine's combine().
#pragma once
#include <vector>

#include "evigrid/raycast/world.hpp"
#include "evigrid/types.hpp"
#include "out/layers.hpp"
#include "paper/delafosse2007/stereo.hpp"

namespace evigrid::driver {

class TbmGrid {
 public:
  TbmGrid(const CellRect& rect, double cell_m);
  /// Cells that meet the box (closed) get `mass` with yes as occupied.
  void fuse_box(Interval x, Interval y, const Existence& mass);
  /// Cells whose centre is between `from` and the box (their convex hull) and not in the box get the negation.
  void fuse_free(raycast::Point from, Interval x, Interval y, const Existence& mass);
  /// Centre of gravity of the 5 × 5 cells around `at`, by m(occupied); `at` itself where nothing is occupied.
  [[nodiscard]] raycast::Point gravity(raycast::Point at) const;
  [[nodiscard]] double cell_m() const { return cell_m_; }
  /// With m(∅) divided out, as the pictures and scores want it.
  [[nodiscard]] Layers layers() const;

 private:
  void fuse(const std::vector<std::size_t>& cells, float occupied, float empty, float nothing);
  [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>((y - rect_.y) * rect_.width + (x - rect_.x));
  }
  CellRect rect_;
  double cell_m_;
  std::vector<float> e_, o_, u_, c_, k_;
};

}  // namespace evigrid::driver
