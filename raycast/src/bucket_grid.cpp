// SPDX-License-Identifier: Apache-2.0
#include "bucket_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace evigrid::raycast {
namespace {

/// Surfaces to a bucket, on average, that the size is chosen for.
constexpr double kPerBucket = 16;
/// At most this many buckets along a side.
constexpr double kMostAlong = 1024;
/// A neighbourhood of more buckets than this is not gathered.
constexpr std::int64_t kMostAround = 4096;
/// Rounding of float coordinates and of products with directions, several times over (capsules_kernel.hpp).
constexpr double kFloatMargin = 4e-6;

}  // namespace

BucketGrid::BucketGrid(const std::vector<Surface>& surfaces, const CapsuleKernel& kernel) : kernel_(&kernel) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  const auto add = [&](Vec2 p, double r) {
    low = {std::min(low.x, p.x - r), std::min(low.y, p.y - r)};
    high = {std::max(high.x, p.x + r), std::max(high.y, p.y + r)};
  };
  for (const Surface& s : surfaces) {
    add(s.a, s.radius);
    if (s.kind == Surface::Kind::segment) add(s.b, 0);
  }
  if (surfaces.empty()) low = high = {};
  origin_ = 0.5 * (low + high);
  extent_m_ = 1 + 0.5 * length(high - low);
  margin_m_ = kFloatMargin * extent_m_;
  low_ = low - Vec2{margin_m_, margin_m_};
  choose_size(surfaces, high - low + 2 * Vec2{margin_m_, margin_m_});

  // Counted, then put in place.
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Surface& s : surfaces) for_each_cell(s, [&](std::size_t cell) { ++first_[cell + 1]; });
  double squares = 0;
  for (std::size_t cell = 1; cell < first_.size(); ++cell) {
    squares += static_cast<double>(first_[cell]) * first_[cell];
    fullest_ = std::max(fullest_, first_[cell]);
    first_[cell] += first_[cell - 1];
  }
  capsules_.resize(first_.back());
  crowd_ = first_.back() > 0 ? squares / first_.back() : 0;
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const Surface& s = surfaces[i];
    const Vec2 end = s.kind == Surface::Kind::segment ? s.b : s.a;
    for_each_cell(s, [&](std::size_t cell) { capsules_.set(next[cell]++, s.a - origin_, end - origin_, s.radius, i); });
  }
}

/// Buckets grow until long surfaces are not in too many of them.
void BucketGrid::choose_size(const std::vector<Surface>& surfaces, Vec2 extent) {
  const double count = static_cast<double>(std::max<std::size_t>(surfaces.size(), 1));
  size_m_ = std::max(std::sqrt(extent.x * extent.y * kPerBucket / count), std::max(extent.x, extent.y) / kMostAlong);
  for (;; size_m_ *= 2) {
    columns_ = 1 + static_cast<std::int64_t>(extent.x / size_m_);
    rows_ = 1 + static_cast<std::int64_t>(extent.y / size_m_);
    std::size_t entries = 0;
    for (const Surface& s : surfaces) for_each_cell(s, [&](std::size_t) { ++entries; });
    if (entries <= 8 * surfaces.size() + 1024) return;
  }
}

BucketGrid::Cells BucketGrid::cells_of(Vec2 low, Vec2 high) const {
  const auto cell = [&](double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(std::floor(v / size_m_), -1.0, static_cast<double>(count)));
  };
  return {std::max<std::int64_t>(cell(low.x - low_.x, columns_), 0),
          std::min(cell(high.x - low_.x, columns_), columns_ - 1),
          std::max<std::int64_t>(cell(low.y - low_.y, rows_), 0), std::min(cell(high.y - low_.y, rows_), rows_ - 1)};
}

/// Calls take(bucket) for all that the surface passes through, and perhaps some beside it.
template <typename Take>
void BucketGrid::for_each_cell(const Surface& s, const Take& take) const {
  const Vec2 b = s.kind == Surface::Kind::segment ? s.b : s.a;
  const double reach = s.radius + margin_m_;
  const Vec2 low{std::min(s.a.x, b.x) - reach, std::min(s.a.y, b.y) - reach};
  const Vec2 high{std::max(s.a.x, b.x) + reach, std::max(s.a.y, b.y) + reach};
  const Cells all = cells_of(low, high);
  for (std::int64_t row = all.y0; row <= all.y1; ++row) {
    Cells here = all;
    if (s.kind == Surface::Kind::segment && all.y1 > all.y0) {
      // The part of the segment between the borders of the row.
      const double below = low_.y + static_cast<double>(row) * size_m_ - reach, above = below + size_m_ + 2 * reach;
      const double t0 = std::clamp((below - s.a.y) / (b.y - s.a.y), 0.0, 1.0);
      const double t1 = std::clamp((above - s.a.y) / (b.y - s.a.y), 0.0, 1.0);
      const double x0 = s.a.x + t0 * (b.x - s.a.x), x1 = s.a.x + t1 * (b.x - s.a.x);
      if (std::isfinite(x0) && std::isfinite(x1))
        here = cells_of({std::min(x0, x1) - reach, low.y}, {std::max(x0, x1) + reach, high.y});
    }
    for (std::int64_t column = here.x0; column <= here.x1; ++column)
      take(static_cast<std::size_t>(row * columns_ + column));
  }
}

bool BucketGrid::gather(Vec2 low, Vec2 high, Vec2 centre, Neighbourhood& n) const {
  const double margin = margin_m_ + kFloatMargin * (std::abs(centre.x - origin_.x) + std::abs(centre.y - origin_.y));
  const Cells c = cells_of(low - Vec2{margin, margin}, high + Vec2{margin, margin});
  std::fill(std::begin(n.ring), std::end(n.ring), 0);
  n.centre = centre;
  n.count = 0;
  n.buckets.half_m = static_cast<float>(size_m_ / 2);
  n.found.clear();
  n.ring_of.clear();
  if (c.x0 > c.x1 || c.y0 > c.y1) return true;
  if ((c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1) > kMostAround) return false;
  // Where the centre is; outside the grid it is taken to be at the border, and rings are nearer than they are.
  const Cells middle = cells_of(centre, centre);
  const std::int64_t x = std::min(middle.x0, columns_ - 1), y = std::min(middle.y0, rows_ - 1);
  for (std::int64_t row = c.y0; row <= c.y1; ++row)
    for (std::int64_t column = c.x0; column <= c.x1; ++column) {
      const auto cell = static_cast<std::uint32_t>(row * columns_ + column);
      if (first_[cell] == first_[cell + 1]) continue;
      const auto away = static_cast<std::uint32_t>(std::max(std::abs(column - x), std::abs(row - y)));
      const std::uint32_t ring = std::min(away, Neighbourhood::kRings - 1);
      n.found.push_back(cell);
      n.ring_of.push_back(ring);
      ++n.ring[ring + 1];
    }
  n.count = static_cast<std::uint32_t>(n.found.size());
  for (std::uint32_t k = 0; k < Neighbourhood::kRings; ++k) n.ring[k + 1] += n.ring[k];
  const std::size_t room = n.found.size() + kSpare;
  if (n.buckets.x.size() < room) {
    n.buckets.x.resize(room), n.buckets.y.resize(room);
    n.buckets.begin.resize(room), n.buckets.end.resize(room);
  }
  // From the outermost back, so that ring[k] ends at the first one of its ring.
  for (std::size_t i = n.found.size(); i-- > 0;) {
    const std::uint32_t cell = n.found[i], at = --n.ring[n.ring_of[i] + 1];
    const Vec2 p = low_ - origin_ + size_m_ * Vec2{cell % columns_ + 0.5, cell / columns_ + 0.5};
    n.buckets.x[at] = static_cast<float>(p.x), n.buckets.y[at] = static_cast<float>(p.y);
    n.buckets.begin[at] = first_[cell], n.buckets.end[at] = first_[cell + 1];
  }
  for (std::uint32_t k = 0; k < Neighbourhood::kRings; ++k) n.ring[k] = n.ring[k + 1];
  n.ring[Neighbourhood::kRings] = n.count;
  return true;
}

FloatWedge BucketGrid::in_float(const Wedge& wedge, Vec2 apex, double limit_m) const {
  const auto f = [](double v) { return static_cast<float>(v); };
  const Vec2 p = apex - origin_;
  return {f(p.x),
          f(p.y),
          f(wedge.arc.right.x),
          f(wedge.arc.right.y),
          f(wedge.arc.left.x),
          f(wedge.arc.left.y),
          f(margin_m_ + kFloatMargin * (std::abs(p.x) + std::abs(p.y) + limit_m))};
}

}  // namespace evigrid::raycast
