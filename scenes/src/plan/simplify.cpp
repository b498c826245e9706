// SPDX-License-Identifier: Apache-2.0
// Why no light leaks: every simplified ring is still closed, and each of its points is within the tolerance of the
// exact one, so free space farther than that from a wall stays on its side; where two walls meet in a single corner
// (where two rings, or a ring and itself, touch) the corner is kept in both; and what is small enough to vanish within
// the tolerance is not touched. Two outlines of a thin wall may cross: a ray then ends at the first of them.
#include <algorithm>
#include <cstdlib>

#include "pixel_outline.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::int32_t kSmall_px = 3;
/// Long rings are cut, so that the worst case (a split that peels off one corner at a time) costs n · this, not n².
constexpr std::size_t kLongestRun = 1024;

bool is_small(const PixelRing& ring) {
  const auto [west, east] = std::minmax_element(ring.begin(), ring.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [south, north] = std::minmax_element(ring.begin(), ring.end(), [](auto& a, auto& b) { return a.y < b.y; });
  return east->x - west->x <= kSmall_px && north->y - south->y <= kSmall_px;
}

std::int64_t squared(std::int64_t v) { return v * v; }

std::int64_t distance2(const Corner& a, const Corner& b) { return squared(b.x - a.x) + squared(b.y - a.y); }

std::int64_t cross(const Corner& a, const Corner& b, const Corner& p) {
  return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
}

std::int64_t dot(const Corner& a, const Corner& b, const Corner& p) {
  return std::int64_t{b.x - a.x} * (p.x - a.x) + std::int64_t{b.y - a.y} * (p.y - a.y);
}

/// Squared distance of p to the piece from a to b (not to its line: a ring may turn back beyond an end).
double off2(const Corner& a, const Corner& b, const Corner& p) {
  const std::int64_t length2 = distance2(a, b), along = dot(a, b, p);
  if (along <= 0 || length2 == 0) return static_cast<double>(distance2(a, p));
  if (along >= length2) return static_cast<double>(distance2(b, p));
  const auto c = static_cast<double>(cross(a, b, p));
  return c * c / static_cast<double>(length2);
}

/// Corners in the middle of a straight piece, joints too: the line goes through them exactly.
void merge_straight(PixelRing& ring) {
  PixelRing merged;
  merged.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner& before = merged.empty() ? ring.back() : merged.back();
    // At the end the first corner that stays: of two equal corners across the seam one must be left.
    const Corner& after = i + 1 < ring.size() ? ring[i + 1] : merged.empty() ? ring[0] : merged.front();
    if (cross(before, ring[i], after) != 0 || dot(ring[i], before, after) > 0) merged.push_back(ring[i]);
  }
  if (merged.size() >= 2) ring.swap(merged);
}

}  // namespace

void Simplifier::keep_anchors(const PixelRing& ring) {
  keep_.assign(ring.size(), false);
  keep_[0] = true;  // the lowest corner and its farthest: ends of the ring's longest stretch, or nearly
  keep_[static_cast<std::size_t>(std::max_element(ring.begin(), ring.end(),
                                                  [&](const Corner& a, const Corner& b) {
                                                    return distance2(ring[0], a) < distance2(ring[0], b);
                                                  }) -
                                 ring.begin())] = true;
  for (std::size_t i = 0, run = 0; i < ring.size(); ++i) {
    keep_[i] = keep_[i] || ring[i].joint || run == kLongestRun;
    run = keep_[i] ? 1 : run + 1;
  }
}

/// Keeps the corners that corners `from` … `to` (to may be ring.size(): the first again) need between them.
void Simplifier::split(const PixelRing& ring, std::size_t from, std::size_t to) {
  open_.assign(1, {from, to});
  while (!open_.empty()) {
    const auto [a, b] = open_.back();
    open_.pop_back();
    const Corner &begin = ring[a], &end = ring[b % ring.size()];
    double worst2 = tolerance_ * tolerance_;
    std::size_t worst = a;
    for (std::size_t i = a + 1; i < b; ++i)
      if (const double d2 = off2(begin, end, ring[i]); d2 > worst2) {
        worst2 = d2;
        worst = i;
      }
    if (worst == a) continue;
    keep_[worst] = true;
    open_.emplace_back(a, worst);
    open_.emplace_back(worst, b);
  }
}

void Simplifier::operator()(PixelRing& ring) {
  if (tolerance_ <= 0 || ring.size() <= 4 || is_small(ring)) return;
  keep_anchors(ring);
  for (std::size_t from = 0; from < ring.size();) {
    std::size_t to = from + 1;
    while (to < ring.size() && !keep_[to]) ++to;
    split(ring, from, to);
    from = to;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (keep_[i]) ring[kept++] = ring[i];
  ring.resize(kept);
  merge_straight(ring);
}

}  // namespace evigrid::scenes
