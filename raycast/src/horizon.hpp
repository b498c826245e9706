// SPDX-License-Identifier: Apache-2.0
// How far a cone can be seen into at all: walls that stand side by side from one edge of it to the other hide whatever
// is farther away than they are. In a building most surfaces within a sensor's range are behind such walls.
#pragma once
#include <vector>

#include "surface.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

class Horizon {
 public:
  void begin(const Wedge& wedge, double reach_m) {
    wedge_ = wedge;
    limit_m_ = nearest_row_m_ = reach_m;
    shades_.clear();
  }
  /// Nothing farther away than this is seen.
  [[nodiscard]] double limit_m() const { return limit_m_; }

  /// Takes account of a straight surface (seen from the apex) that has a point in the wedge.
  void add(const Surface& s);

 private:
  struct Shade {
    Vec2 right, left;   ///< ends of the surface
    double farthest_m;  ///< of its part in the wedge
  };
  /// Farthest of a row of shades from edge to edge, each nearer than `below_m`; +∞ when there is none.
  [[nodiscard]] double row(double below_m) const;

  Wedge wedge_;
  double limit_m_ = 0, nearest_row_m_ = 0;
  std::vector<Shade> shades_;
};

}  // namespace evigrid::raycast
