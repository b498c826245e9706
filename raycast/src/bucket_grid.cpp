// SPDX-License-Identifier: Apache-2.0
#include "bucket_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace evigrid::raycast {
namespace {

/// Surfaces to a bucket, on average, that the size is chosen for.
constexpr double kPerBucket = 6;
/// At most this many buckets along a side.
constexpr double kMostAlong = 1024;
/// A neighbourhood of more buckets than this is not gathered.
constexpr std::int64_t kMostAround = 4096;
/// Rounding of float coordinates and of products with directions, several times over (capsules_kernel.hpp).
constexpr double kFloatMargin = 4e-6;

/// Puts the few proposals in the order of their distance.
void sort(Proposals& p, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i) {
    const float nearest = p.nearest_m[i];
    const std::uint32_t name = p.name[i];
    std::size_t k = i;
    for (; k > 0 && p.nearest_m[k - 1] > nearest; --k) p.nearest_m[k] = p.nearest_m[k - 1], p.name[k] = p.name[k - 1];
    p.nearest_m[k] = nearest, p.name[k] = name;
  }
}

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
  std::fill(std::begin(n.zone), std::end(n.zone), 0);
  n.centre = centre;
  n.buckets.half_m = static_cast<float>(size_m_ / 2);
  n.found.clear();
  n.zone_of.clear();
  if (c.x0 > c.x1 || c.y0 > c.y1) return true;
  if ((c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1) > kMostAround) return false;
  const auto middle = [&](std::int64_t column, std::int64_t row) {
    return low_ + size_m_ * Vec2{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
  };
  for (std::int64_t row = c.y0; row <= c.y1; ++row)
    for (std::int64_t column = c.x0; column <= c.x1; ++column) {
      const auto cell = static_cast<std::uint32_t>(row * columns_ + column);
      if (first_[cell] == first_[cell + 1]) continue;
      const Vec2 p = middle(column, row) - centre;
      // In the larger of both coordinates, which is never more than the distance.
      const double away = std::max(std::abs(p.x), std::abs(p.y)) / size_m_ - 0.5;
      std::uint32_t zone = 0;
      for (double from = 2; zone + 1 < Neighbourhood::kZones && away >= from; from *= 2) ++zone;
      n.found.push_back(cell);
      n.zone_of.push_back(zone);
      ++n.zone[zone + 1];
    }
  for (int k = 0; k < Neighbourhood::kZones; ++k) n.zone[k + 1] += n.zone[k];
  const std::size_t room = n.found.size() + kSpare;
  if (n.buckets.x.size() < room) {
    n.buckets.x.resize(room), n.buckets.y.resize(room);
    n.buckets.begin.resize(room), n.buckets.end.resize(room);
  }
  std::uint32_t next[Neighbourhood::kZones];
  std::copy_n(n.zone, Neighbourhood::kZones, next);
  for (std::size_t i = 0; i < n.found.size(); ++i) {
    const std::uint32_t cell = n.found[i], at = next[n.zone_of[i]]++;
    const Vec2 p = middle(cell % columns_, cell / columns_) - origin_;
    n.buckets.x[at] = static_cast<float>(p.x), n.buckets.y[at] = static_cast<float>(p.y);
    n.buckets.begin[at] = first_[cell], n.buckets.end[at] = first_[cell + 1];
  }
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

void BucketGrid::search(const std::vector<Surface>& surfaces, const Neighbourhood& n, const Wedge& wedge, Vec2 apex,
                        NearestEcho& nearest, Room& room) const {
  const FloatWedge w = in_float(wedge, apex, nearest.limit_m());
  const double moved_m = length(apex - n.centre);
  room.surfaces.make_room(fullest_);
  room.buckets.make_room(n.found.size());
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  for (int zone = 0; zone < Neighbourhood::kZones; ++zone) {
    const double from_m = zone == 0 ? 0 : std::ldexp(size_m_, zone) - moved_m - margin_m_;
    if (from_m > nearest.limit_m()) return;
    if (n.zone[zone] == n.zone[zone + 1]) continue;
    const std::size_t buckets = kernel_->squares(n.buckets, n.zone[zone], n.zone[zone + 1], w,
                                                 static_cast<float>(nearest.limit_m()), room.buckets);
    sort(room.buckets, buckets);
    for (std::size_t b = 0; b < buckets && room.buckets.nearest_m[b] <= nearest.limit_m(); ++b) {
      const std::uint32_t bucket = room.buckets.name[b];
      const std::size_t count = kernel_->capsules(capsules_, n.buckets.begin[bucket], n.buckets.end[bucket], w,
                                                  static_cast<float>(nearest.limit_m()), room.surfaces, 0);
      sort(room.surfaces, count);
      for (std::size_t i = 0; i < count && room.surfaces.nearest_m[i] <= nearest.limit_m(); ++i) {
        const std::uint32_t number = room.surfaces.name[i];
        if (number == last) continue;  // it passes through the bucket before, too
        nearest.consider(seen_from(surfaces[number], apex));
        last = number;
      }
    }
  }
}

void BucketGrid::collect(const Neighbourhood& n, const Wedge& wedge, Vec2 apex, double limit_m, Room& room,
                         std::vector<std::uint32_t>& numbers) const {
  const FloatWedge w = in_float(wedge, apex, limit_m);
  const auto limit = static_cast<float>(limit_m);
  room.buckets.make_room(n.found.size());
  const std::size_t buckets =
      kernel_->squares(n.buckets, 0, static_cast<std::uint32_t>(n.found.size()), w, limit, room.buckets);
  std::size_t count = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::uint32_t bucket = room.buckets.name[b];
    room.surfaces.make_room(count + fullest_);
    count =
        kernel_->capsules(capsules_, n.buckets.begin[bucket], n.buckets.end[bucket], w, limit, room.surfaces, count);
  }
  numbers.assign(room.surfaces.name.begin(), room.surfaces.name.begin() + static_cast<std::ptrdiff_t>(count));
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace evigrid::raycast
