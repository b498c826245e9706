// SPDX-License-Identifier: Apache-2.0
// The brute-force answer, by angles instead of directions and by an envelope instead of candidates. All angles at which
// anything starts, ends, turns silent or crosses are sorted; between two neighbours the order of the surfaces is fixed,
// so the one met first at the middle is met first throughout, and its distance is minimised there analytically.
#include "evigrid/raycast/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "query.hpp"
#include "reference_polar.hpp"
#include "surface.hpp"
#include "tolerance.hpp"

namespace evigrid::raycast {
namespace {

using namespace reference;

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Sweep {
 public:
  Sweep(const std::vector<Surface>& surfaces, const ConeQuery& q)
      : half_rad_(q.aperture_rad / 2 + kEdgeSlack_rad), max_range_m_(q.max_range_m) {
    for (const Surface& s : surfaces) seen_.push_back(polar(seen_from(s, {q.x_m, q.y_m}), q.yaw_rad));
    for (const Polar& p : seen_) contact_ = contact_ || p.contact;
    if (contact_) return;
    add_event(-half_rad_);
    add_event(half_rad_);
    for (const Polar& p : seen_) add_events(p);
    for (std::size_t i = 0; i < seen_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) add_crossings(seen_[i], seen_[j]);
    std::sort(events_.begin(), events_.end());
  }

  double nearest_m() {
    if (contact_) return 0;
    for (std::size_t i = 0; i + 1 < events_.size(); ++i)
      if (events_[i + 1] - events_[i] > kEventRounding_rad) look(events_[i], events_[i + 1]);
    for (double angle : events_) look_along(angle);
    return best_m_;
  }

 private:
  void add_event(double angle_rad) {
    const double a = wrapped(angle_rad);
    if (std::abs(a) <= half_rad_) events_.push_back(a);
  }

  void add_events(const Polar& p) {
    add_limits_of_hearing(p);
    if (p.round) {
      const double tangent = p.inside() ? kPi : std::asin(p.radius_m / p.distance_m);
      const double sine = p.distance_m > 0 ? p.radius_m * std::sin(p.critical_rad) / p.distance_m : 1;
      const double silent = std::asin(std::min(1.0, sine));
      for (double off : {tangent, -tangent, silent, -silent, kPi - silent, kPi + silent})
        add_event(p.towards_rad + off);
    } else {
      add_event(p.begin_rad);
      add_event(p.begin_rad + p.span_rad);
      add_event(p.towards_rad + p.critical_rad);
      add_event(p.towards_rad - p.critical_rad);
    }
  }

  /// Where the surface becomes too far to be heard: bisected, stretch by stretch.
  void add_limits_of_hearing(const Polar& p) {
    const auto heard = [&](double angle) { return audible(p, range_at(p, angle), max_range_m_); };
    const std::vector<double> turns = turning_points(p);
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
      double low = turns[i], high = turns[i + 1];
      const bool at_low = heard(low);
      if (heard(high) == at_low) continue;
      for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (heard(middle) == at_low ? low : high) = middle;
      }
      add_event(low);
    }
  }

  [[nodiscard]] bool answers(const Polar& p, double angle_rad) const {
    return reaches(p, angle_rad) && echoes(p, angle_rad) && audible(p, range_at(p, angle_rad), max_range_m_);
  }

  /// Crossings by following both ranges along the common angles: a sign change is bracketed and bisected, and where a
  /// circle may dip below the other surface and come back, the deepest point is searched first. Slow, and nothing like
  /// the formulas of the caster.
  void add_crossings(const Polar& p, const Polar& q) {
    if (least_m(p) > most_m(q) || least_m(q) > most_m(p)) return;
    std::vector<double> grid;
    for (const Polar* s : {&p, &q}) add_corners(*s, grid);
    constexpr int kSteps = 16;
    for (int k = 0; k <= kSteps; ++k) grid.push_back(half_rad_ * (2.0 * k / kSteps - 1));
    std::sort(grid.begin(), grid.end());
    for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
      const double low = grid[k], high = grid[k + 1];
      if (low < -half_rad_ || high > half_rad_ || high - low < 1e-14) continue;
      const double at_low = range_at(p, low) - range_at(q, low), at_high = range_at(p, high) - range_at(q, high);
      if (!std::isfinite(at_low) || !std::isfinite(at_high)) continue;
      if ((at_low < 0) != (at_high < 0)) {
        add_sign_change(p, q, low, high);
      } else if (p.round || q.round) {
        const double deepest = deepest_point(p, q, low, high, at_low < 0 ? -1 : 1);
        if ((range_at(p, deepest) - range_at(q, deepest) < 0) == (at_low < 0)) continue;
        add_sign_change(p, q, low, deepest);
        add_sign_change(p, q, deepest, high);
      }
    }
  }

  static void add_corners(const Polar& p, std::vector<double>& angles) {
    angles.push_back(p.towards_rad);
    const double tangent = p.round && !p.inside() ? std::asin(p.radius_m / p.distance_m) : kPi;
    for (double off : {-tangent, tangent}) angles.push_back(wrapped(p.towards_rad + off));
    if (p.round) return;
    for (double off : {0.0, p.span_rad}) angles.push_back(wrapped(p.begin_rad + off));
  }

  void add_sign_change(const Polar& p, const Polar& q, double low, double high) {
    const bool below = range_at(p, low) < range_at(q, low);
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      ((range_at(p, middle) < range_at(q, middle)) == below ? low : high) = middle;
    }
    events_.push_back(low);
  }

  static double deepest_point(const Polar& p, const Polar& q, double low, double high, double sign) {
    for (int step = 0; step < 60; ++step) {
      const double l = low + (high - low) / 3, h = high - (high - low) / 3;
      const double at_l = sign * (range_at(p, l) - range_at(q, l)), at_h = sign * (range_at(p, h) - range_at(q, h));
      (at_l < at_h ? high : low) = at_l < at_h ? h : l;
    }
    return (low + high) / 2;
  }

  /// No event lies strictly between the two angles.
  void look(double begin_rad, double end_rad) {
    const double middle = (begin_rad + end_rad) / 2;
    double first = kInfinity;
    for (const Polar& p : seen_) first = std::min(first, range_at(p, middle));
    if (first == kInfinity) return;
    for (const Polar& p : seen_)
      if (range_at(p, middle) <= first + kTie * (1 + first) && answers(p, middle))
        best_m_ = std::min(best_m_, least(p, begin_rad, end_rad));
  }

  /// Surfaces whose echoing part in the cone is this one ray: edge-on, at its critical incidence, on the cone's edge.
  void look_along(double angle_rad) {
    const auto there = [&](const Polar& p, double a) {
      return std::abs(a) <= half_rad_ && range_at(p, a) < kInfinity && answers(p, a);
    };
    double first = kInfinity;
    for (const Polar& p : seen_) first = std::min(first, range_at(p, angle_rad));
    for (const Polar& p : seen_) {
      const double range = range_at(p, angle_rad);
      if (range > first + kTie * (1 + first) || range >= best_m_ || !there(p, angle_rad)) continue;
      if (p.edge_on() || (!there(p, angle_rad - kOneRay_rad) && !there(p, angle_rad + kOneRay_rad))) best_m_ = range;
    }
  }

  static double least(const Polar& p, double begin_rad, double end_rad) {
    double best = range_at(p, (begin_rad + end_rad) / 2);
    const auto consider = [&](double angle) { best = std::min(best, range_at(p, angle)); };
    consider(begin_rad);
    consider(end_rad);
    // Straight ahead of the foot or the near point; the wall behind is the near point from inside a circle.
    const double nearest = p.inside() ? wrapped(p.towards_rad + kPi) : p.towards_rad;
    if (nearest > begin_rad && nearest < end_rad) consider(nearest);
    return best;
  }

  double half_rad_, max_range_m_;
  bool contact_ = false;
  double best_m_ = kInfinity;
  std::vector<Polar> seen_;
  std::vector<double> events_;
};

}  // namespace

Echo reference_cone(const World& world, const ConeQuery& query) {
  check(query);
  return echo_at(Sweep(take_apart(world), query).nearest_m(), query);
}

double reference_ray(const World& world, double x_m, double y_m, double angle_rad, double max_range_m) {
  check_ray(x_m, y_m, angle_rad, max_range_m);
  std::vector<Polar> seen;
  for (const Surface& s : take_apart(world)) seen.push_back(polar(seen_from(s, {x_m, y_m}), angle_rad));
  const auto range = [](const Polar& p) { return p.contact ? 0 : range_at(p, 0); };
  double first = kInfinity, heard = kInfinity;
  for (const Polar& p : seen) first = std::min(first, range(p));
  for (const Polar& p : seen)
    if (range(p) <= first + kTie * (1 + first) && audible(p, range(p), max_range_m)) heard = std::min(heard, range(p));
  return std::min(heard, heard < kInfinity ? max_range_m : kInfinity);
}

}  // namespace evigrid::raycast
