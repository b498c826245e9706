// SPDX-License-Identifier: Apache-2.0
#include "tour/nearby.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace evigrid::scenes {
namespace {

using raycast::Point;

constexpr std::int64_t kMostBins = 1 << 24;
constexpr double kMostItems = 1 << 26;  // of all bins, about

double square(double v) { return v * v; }
double squared_length(Point a, Point b) { return square(b.x_m - a.x_m) + square(b.y_m - a.y_m); }

double from_point(Point p, Point a, Point b) {
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, length = dx * dx + dy * dy;
  const double t = length > 0 ? ((p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy) / length : 0;
  if (t <= 0) return squared_length(p, a);
  if (t >= 1) return squared_length(p, b);
  return squared_length(p, {a.x_m + t * dx, a.y_m + t * dy});
}

double side(Point a, Point b, Point p) { return (b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m); }

}  // namespace

double squared_distance(Point a, Point b, const Segment& s) {
  const double sa = side(a, b, s.a), sb = side(a, b, s.b), ta = side(s.a, s.b, a), tb = side(s.a, s.b, b);
  if (((sa < 0 && sb > 0) || (sa > 0 && sb < 0)) && ((ta < 0 && tb > 0) || (ta > 0 && tb < 0))) return 0;
  return std::min({from_point(a, s.a, s.b), from_point(b, s.a, s.b), from_point(s.a, a, b), from_point(s.b, a, b)});
}

double squared_distance(Point a, Point b, const Ring& r) {
  const double nearest = std::sqrt(from_point(r.centre, a, b));
  if (nearest >= r.radius_m) return square(nearest - r.radius_m);
  const double farthest = std::sqrt(std::max(squared_length(r.centre, a), squared_length(r.centre, b)));
  return farthest >= r.radius_m ? 0 : square(r.radius_m - farthest);
}

Nearby::Nearby(const Outline& outline, double bin_m) : outline_(&outline), bin_m_(bin_m) {
  const double inf = std::numeric_limits<double>::infinity();
  Point low{inf, inf}, high{-inf, -inf};
  const auto include = [&](Point p, double r) {
    low = {std::min(low.x_m, p.x_m - r), std::min(low.y_m, p.y_m - r)};
    high = {std::max(high.x_m, p.x_m + r), std::max(high.y_m, p.y_m + r)};
  };
  for (const Segment& s : outline.segments) {
    include(s.a, 0);
    include(s.b, 0);
  }
  for (const Ring& r : outline.rings) include(r.centre, r.radius_m);
  if (low.x_m > high.x_m) low = high = {};
  const auto count = [&](double length) { return std::floor(length / bin_m_) + 1; };
  while (count(high.x_m - low.x_m) * count(high.y_m - low.y_m) > static_cast<double>(kMostBins)) bin_m_ *= 2;
  double way_m = 0;  // along x and along y: a curve is in a bin or two for each bin_m of it
  for (const Segment& s : outline.segments) way_m += std::abs(s.b.x_m - s.a.x_m) + std::abs(s.b.y_m - s.a.y_m);
  for (const Ring& r : outline.rings) way_m += 8 * r.radius_m;
  while (way_m / bin_m_ > kMostItems) bin_m_ *= 2;
  x_m_ = low.x_m;
  y_m_ = low.y_m;
  width_ = static_cast<std::int64_t>(count(high.x_m - low.x_m));
  height_ = static_cast<std::int64_t>(count(high.y_m - low.y_m));

  // Twice over everything: count, then place.
  const double slack = bin_m_ * 1e-9;  // a curve on a border is in both bins
  const auto place = [&](auto put) {
    for (std::size_t i = 0; i < outline.segments.size(); ++i) {
      const Segment& s = outline.segments[i];
      any_bin(s.a, s.b, slack, [&](std::size_t bin) { return put(bin, i), false; });
    }
    for (std::size_t i = 0; i < outline.rings.size(); ++i) {
      each_bin_of(outline.rings[i], slack, [&](std::size_t bin) { put(bin, outline.segments.size() + i); });
    }
  };
  begin_.assign(static_cast<std::size_t>(width_ * height_) + 1, 0);
  place([&](std::size_t bin, std::size_t) { ++begin_[bin + 1]; });
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  items_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  place([&](std::size_t bin, std::size_t item) { items_[next[bin]++] = static_cast<std::uint32_t>(item); });
}

template <class Visit>
void Nearby::each_bin_of(const Ring& r, double slack_m, Visit visit) const {
  const auto column = [&](double x_m) {
    return static_cast<std::int64_t>(
        std::clamp(std::floor((x_m - x_m_) / bin_m_), 0.0, static_cast<double>(width_ - 1)));
  };
  const auto row = [&](double y_m) {
    return static_cast<std::int64_t>(
        std::clamp(std::floor((y_m - y_m_) / bin_m_), 0.0, static_cast<double>(height_ - 1)));
  };
  const double outer_m = r.radius_m + slack_m, inner_m = std::max(r.radius_m - slack_m, 0.0);
  for (std::int64_t y = row(r.centre.y_m - outer_m), last = row(r.centre.y_m + outer_m); y <= last; ++y) {
    const double low = y_m_ + static_cast<double>(y) * bin_m_ - r.centre.y_m, high = low + bin_m_;
    const double near = std::max({low, -high, 0.0}), far = std::max(std::abs(low), std::abs(high));
    const double reach = std::sqrt(std::max(square(outer_m) - square(near), 0.0)) + slack_m;
    // Within the hole of this row nothing of the circle passes, less a bin on either side.
    const double hole = std::sqrt(std::max(square(inner_m) - square(far), 0.0)) - slack_m;
    const std::int64_t first = column(r.centre.x_m - reach), end = column(r.centre.x_m + reach) + 1;
    std::int64_t hole_first = end, hole_end = end;
    if (hole > 0) {
      hole_first = std::min(column(r.centre.x_m - hole) + 1, end);
      hole_end = std::max(column(r.centre.x_m + hole), hole_first);
    }
    for (std::int64_t x = first; x < hole_first; ++x) visit(static_cast<std::size_t>(y * width_ + x));
    for (std::int64_t x = hole_end; x < end; ++x) visit(static_cast<std::size_t>(y * width_ + x));
  }
}

template <class Visit>
bool Nearby::any_bin(Point a, Point b, double reach_m, Visit visit) const {
  if (a.y_m > b.y_m) std::swap(a, b);
  const auto bin = [&](double v, double origin, std::int64_t count) {
    return static_cast<std::int64_t>(
        std::clamp(std::floor((v - origin) / bin_m_), -1.0, static_cast<double>(count)));  // −1, count: outside
  };
  const std::int64_t first_row = std::max<std::int64_t>(bin(a.y_m - reach_m, y_m_, height_), 0);
  const std::int64_t last_row = std::min(bin(b.y_m + reach_m, y_m_, height_), height_ - 1);
  for (std::int64_t row = first_row; row <= last_row; ++row) {
    // The part of the leg within reach of this row of bins.
    const double low = y_m_ + static_cast<double>(row) * bin_m_ - reach_m, high = low + bin_m_ + 2 * reach_m;
    double xa = a.x_m, xb = b.x_m;
    if (b.y_m > a.y_m) {
      const double slope = (b.x_m - a.x_m) / (b.y_m - a.y_m);
      if (a.y_m < low) xa = a.x_m + (low - a.y_m) * slope;
      if (b.y_m > high) xb = a.x_m + (high - a.y_m) * slope;
    }
    const std::int64_t first = std::max<std::int64_t>(bin(std::min(xa, xb) - reach_m, x_m_, width_), 0);
    const std::int64_t last = std::min(bin(std::max(xa, xb) + reach_m, x_m_, width_), width_ - 1);
    for (std::int64_t column = first; column <= last; ++column)
      if (visit(static_cast<std::size_t>(row * width_ + column))) return true;
  }
  return false;
}

bool Nearby::keeps(Point a, Point b, double clearance_m) const {
  const double least = clearance_m * clearance_m;
  return !any_bin(a, b, clearance_m, [&](std::size_t bin) {
    for (std::uint32_t k = begin_[bin]; k < begin_[bin + 1]; ++k) {
      const std::size_t item = items_[k], segments = outline_->segments.size();
      const double d = item < segments ? squared_distance(a, b, outline_->segments[item])
                                       : squared_distance(a, b, outline_->rings[item - segments]);
      if (d < least) return true;
    }
    return false;
  });
}

}  // namespace evigrid::scenes
