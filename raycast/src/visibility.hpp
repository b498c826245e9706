// SPDX-License-Identifier: Apache-2.0
// The slow and exact answer, needed when the nearest surface point in the cone gives no echo: which echoing point is
// nearest among those that nothing hides. Plane visibility in double, by candidates.
#pragma once
#include <cstddef>
#include <vector>

#include "horizon.hpp"
#include "rays.hpp"
#include "surface.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {

/// Asked about surfaces like NearestEcho; then solved. Used again and again, it keeps its memory.
class VisibleEcho {
 public:
  void begin(const Wedge& wedge, double max_range_m);

  /// `s`: seen from the apex, which it does not touch; its name orders surfaces at the same distance, and asking twice
  /// does no harm. Those that absorb too much to be heard from where they are hide all the same.
  void consider(const Surface& s, SurfaceName name);
  [[nodiscard]] double limit_m() const { return horizon_.limit_m(); }

  /// +∞ when nothing is visible and echoes within max_range_m.
  [[nodiscard]] double solve();

 private:
  struct Seen {
    Surface surface;
    double nearest_m;  ///< of its points in the wedge
    SurfaceName name;
  };
  struct Candidate {
    double range_m;
    Vec2 direction;
  };
  void sort();
  void add_events(const Surface& s);
  void try_piece(std::size_t i, const Piece& piece);
  [[nodiscard]] bool visible(std::size_t i, const Arc& arc, Vec2 u);
  [[nodiscard]] bool met_first(std::size_t i, Vec2 u);

  Wedge wedge_;
  Horizon horizon_;
  double best_m_ = 0, max_range_m_ = 0;
  std::vector<Seen> seen_;  ///< sorted: nearest first
  std::vector<Met> met_;    ///< the same
  std::vector<Vec2> events_;
  std::vector<Candidate> candidates_;
};

}  // namespace evigrid::raycast
