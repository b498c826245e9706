// SPDX-License-Identifier: Apache-2.0
// On a piece of a surface the distance has one minimum; where that point is hidden, the minimum over the visible rest
// lies where visibility changes: at the directions of ends and tangents of other surfaces, where surfaces cross, or at
// the ends of the piece. These candidates are tried from the nearest on. A candidate counts when the piece is what a
// ray meets first just beside it, so that the limit of visible points counts and a point that only touches from behind
// does not.
#include "visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crossing.hpp"
#include "reject.hpp"
#include "tolerance.hpp"

namespace evigrid::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// "Just beside": a gap between two surfaces narrower than this (0.1 µm at 10 m) counts as closed.
constexpr double kBeside_rad = 1e-8;

struct Seen {
  Surface surface;
  double nearest_m;  ///< of its points in the wedge
};

struct Candidate {
  double range_m;
  Vec2 direction;
};

class Visibility {
 public:
  Visibility(const std::vector<Surface>& surfaces, const Wedge& wedge, double max_range_m)
      : wedge_(wedge), best_m_(std::nextafter(max_range_m + kContact_m, kInfinity)), max_range_m_(max_range_m) {
    // What is too far away neither answers nor hides: without it the answer is that of the surfaces in the cone alone,
    // and not of what an index proposed.
    const double reach_m = max_range_m + kContact_m;
    for (const Surface& s : surfaces) {
      if (surely_outside(s, wedge, reach_m)) continue;
      const auto p = nearest_in_wedge(s, wedge);
      if (!p) continue;
      if (const double nearest_m = length(*p); nearest_m <= reach_m) seen_.push_back({s, nearest_m});
    }
    std::stable_sort(seen_.begin(), seen_.end(),
                     [](const Seen& l, const Seen& r) { return l.nearest_m < r.nearest_m; });
  }

  double solve() {
    for (std::size_t i = 0; i < seen_.size() && seen_[i].nearest_m < best_m_; ++i) {
      const Pieces pieces = echo_pieces(seen_[i].surface, wedge_, max_range_m_);
      for (int k = 0; k < pieces.count; ++k) try_piece(i, pieces.piece[k]);
    }
    return best_m_ <= max_range_m_ + kContact_m ? best_m_ : kInfinity;
  }

 private:
  void add_events(const Surface& s) {
    if (s.kind == Surface::Kind::segment) {
      events_.push_back(unit(s.a));
      events_.push_back(unit(s.b));
    } else if (const double distance = length(s.a); distance > s.radius) {
      const double sine = s.radius / distance, cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
      events_.push_back(rotated(unit(s.a), cosine, -sine));
      events_.push_back(rotated(unit(s.a), cosine, sine));
    }
  }

  void try_piece(std::size_t i, const Piece& piece) {
    const double nearest = length(piece.nearest);
    if (nearest >= best_m_) return;
    if (visible(i, piece.arc, unit(piece.nearest))) {
      best_m_ = nearest;
      return;
    }
    if (events_.empty())
      for (const Seen& seen : seen_) add_events(seen.surface);
    const Surface& surface = seen_[i].surface;
    candidates_.clear();
    const auto add = [&](Vec2 u) {
      if (!contains(piece.arc, u)) return;
      const double range = hit_distance(surface, u);
      if (range < best_m_) candidates_.push_back({range, u});
    };
    add(piece.arc.right);
    add(piece.arc.left);
    for (Vec2 u : events_) add(u);
    for (std::size_t j = 0; j < seen_.size(); ++j) {
      if (j == i) continue;
      const Crossings crossings = crossings_of(surface, seen_[j].surface);
      for (int k = 0; k < crossings.count; ++k) add(unit(crossings.point[k]));
    }
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& l, const Candidate& r) { return l.range_m < r.range_m; });
    for (const Candidate& c : candidates_) {
      if (!visible(i, piece.arc, c.direction)) continue;
      best_m_ = c.range_m;
      return;
    }
  }

  /// Whether the piece is met first just beside `u`, on either side of it that belongs to the piece.
  bool visible(std::size_t i, const Arc& arc, Vec2 u) const {
    if (sine_of_span(arc) < 4 * kBeside_rad) return met_first(i, unit(arc.right + arc.left));
    const Vec2 right = nudged(u, -kBeside_rad), left = nudged(u, kBeside_rad);
    return (contains(arc, right) && met_first(i, right)) || (contains(arc, left) && met_first(i, left));
  }

  bool met_first(std::size_t i, Vec2 u) const {
    const double range = hit_distance(seen_[i].surface, u);
    const double hidden_below = range - kTie * (1 + range);
    for (std::size_t j = 0; j < seen_.size() && seen_[j].nearest_m < hidden_below; ++j)
      if (j != i && hit_distance(seen_[j].surface, u) < hidden_below) return false;
    return true;
  }

  Wedge wedge_;
  double best_m_, max_range_m_;
  std::vector<Seen> seen_;  ///< nearest first
  std::vector<Vec2> events_;
  std::vector<Candidate> candidates_;
};

}  // namespace

double nearest_visible_echo(const std::vector<Surface>& surfaces, const Wedge& wedge, double max_range_m) {
  return Visibility(surfaces, wedge, max_range_m).solve();
}

}  // namespace evigrid::raycast
