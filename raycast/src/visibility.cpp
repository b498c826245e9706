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

}  // namespace

void VisibleEcho::begin(const Wedge& wedge, double max_range_m) {
  wedge_ = wedge;
  max_range_m_ = max_range_m;
  best_m_ = std::nextafter(max_range_m + kContact_m, kInfinity);
  horizon_.begin(wedge, max_range_m + kContact_m);
  seen_.clear();
  events_.clear();
}

void VisibleEcho::consider(const Surface& s, SurfaceName name) {
  if (surely_outside(s, wedge_, limit_m())) return;
  const auto p = nearest_in_wedge(s, wedge_);
  if (!p) return;
  const double nearest_m = length(*p);
  if (nearest_m > limit_m()) return;
  seen_.push_back({s, nearest_m, name});
  horizon_.add(s);
}

/// What is too far away neither answers nor hides: without it the answer is that of the surfaces in the cone alone, and
/// not of what an index proposed, how often, or in which order.
void VisibleEcho::sort() {
  std::erase_if(seen_, [&](const Seen& s) { return s.nearest_m > limit_m(); });
  std::sort(seen_.begin(), seen_.end(), [](const Seen& l, const Seen& r) {
    return l.nearest_m != r.nearest_m ? l.nearest_m < r.nearest_m : l.name < r.name;
  });
  const auto same = [](const Seen& l, const Seen& r) { return l.name == r.name; };
  seen_.erase(std::unique(seen_.begin(), seen_.end(), same), seen_.end());
}

double VisibleEcho::solve() {
  sort();
  met_.clear();
  for (const Seen& s : seen_) met_.emplace_back(s.surface);
  for (std::size_t i = 0; i < seen_.size() && seen_[i].nearest_m < best_m_; ++i) {
    const Pieces pieces = echo_pieces(seen_[i].surface, wedge_, max_range_m_);
    for (int k = 0; k < pieces.count; ++k) try_piece(i, pieces.piece[k]);
  }
  return best_m_ <= max_range_m_ + kContact_m ? best_m_ : kInfinity;
}

void VisibleEcho::add_events(const Surface& s) {
  if (s.kind == Surface::Kind::segment) {
    events_.push_back(unit(s.a));
    events_.push_back(unit(s.b));
  } else if (const double distance = length(s.a); distance > s.radius) {
    const double sine = s.radius / distance, cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
    events_.push_back(rotated(unit(s.a), cosine, -sine));
    events_.push_back(rotated(unit(s.a), cosine, sine));
  }
}

void VisibleEcho::try_piece(std::size_t i, const Piece& piece) {
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
    const double range = met_[i].distance(u);
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
bool VisibleEcho::visible(std::size_t i, const Arc& arc, Vec2 u) {
  if (sine_of_span(arc) < 4 * kBeside_rad) return met_first(i, unit(arc.right + arc.left));
  const Vec2 right = nudged(u, -kBeside_rad), left = nudged(u, kBeside_rad);
  return (contains(arc, right) && met_first(i, right)) || (contains(arc, left) && met_first(i, left));
}

bool VisibleEcho::met_first(std::size_t i, Vec2 u) {
  const double range = met_[i].distance(u);
  const double hidden_below = range - kTie * (1 + range);
  for (std::size_t j = 0; j < seen_.size() && seen_[j].nearest_m < hidden_below; ++j)
    if (j != i && met_[j].distance(u) < hidden_below) return false;
  return true;
}

}  // namespace evigrid::raycast
