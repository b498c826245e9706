// SPDX-License-Identifier: Apache-2.0
// The second index: a grid of square buckets over the world, each with the surfaces that pass through it. For cones
// only, and for many of them: a bucket holds about a vector of surfaces, clipped at once (capsules.hpp). Like Embree's
// hierarchy it proposes, in float and with a margin; doubles decide.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "capsules.hpp"
#include "rays.hpp"
#include "surface.hpp"

namespace evigrid::raycast {

/// Puts the few proposals in the order of their distance.
inline void sort(Proposals& p, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i) {
    const float nearest = p.nearest_m[i];
    const std::uint32_t name = p.name[i];
    std::size_t k = i;
    for (; k > 0 && p.nearest_m[k - 1] > nearest; --k) p.nearest_m[k] = p.nearest_m[k - 1], p.name[k] = p.name[k - 1];
    p.nearest_m[k] = nearest, p.name[k] = name;
  }
}

class BucketGrid {
 public:
  explicit BucketGrid(const std::vector<Surface>& surfaces, const CapsuleKernel& kernel = capsule_kernel());

  /// Surfaces in the bucket of an average surface. Where most of them crowd in few buckets a hierarchy is better.
  [[nodiscard]] double crowd() const { return crowd_; }

  /// The buckets that some cones of one neighbourhood may reach, from the inner to the outer ones: zone k has those
  /// from 2^k to less than 2^(k+1) buckets away from the one in the centre, along x or y; zone 0 that one, too.
  struct Neighbourhood {
    static constexpr std::uint32_t kZones = 5, kRings = 1u << kZones;
    Vec2 centre;
    std::uint32_t count = 0;
    Squares buckets;
    std::uint32_t ring[kRings + 1];  ///< ring k: buckets from ring[k] to ring[k + 1]; all the outer ones in the last
    std::vector<std::uint32_t> found, ring_of;
  };
  /// False when there are more buckets than are worth going through; then nothing is gathered.
  bool gather(Vec2 low, Vec2 high, Vec2 centre, Neighbourhood& out) const;

  /// What a search needs room for.
  struct Room {
    Proposals buckets, surfaces;
  };
  /// Calls consider(surface seen from the apex, name) of every surface that may be in the wedge within limit_m() of the
  /// asking one, which may shrink. The wedge up to there must lie in the neighbourhood's box.
  template <typename Asking>
  void search(const std::vector<Surface>& surfaces, const Neighbourhood& n, const Wedge& wedge, Vec2 apex,
              Asking& asking, Room& room) const;

 private:
  struct Cells {
    std::int64_t x0, x1, y0, y1;  ///< both ends included
  };
  [[nodiscard]] Cells cells_of(Vec2 low, Vec2 high) const;
  template <typename Take>
  void for_each_cell(const Surface& s, const Take& take) const;
  void choose_size(const std::vector<Surface>& surfaces, Vec2 extent);
  [[nodiscard]] FloatWedge in_float(const Wedge& wedge, Vec2 apex, double limit_m) const;

  const CapsuleKernel* kernel_;
  Vec2 low_, origin_;  ///< corner of the grid; its middle, to which the floats are relative
  double size_m_ = 1, margin_m_ = 0, extent_m_ = 0, crowd_ = 0;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each bucket, row by row, and one more
  std::uint32_t fullest_ = 0;
  Capsules capsules_;
};

template <typename Asking>
void BucketGrid::search(const std::vector<Surface>& surfaces, const Neighbourhood& n, const Wedge& wedge, Vec2 apex,
                        Asking& asking, Room& room) const {
  const FloatWedge w = in_float(wedge, apex, asking.limit_m());
  const double moved_m = length(apex - n.centre) + margin_m_;
  room.surfaces.make_room(fullest_);
  room.buckets.make_room(n.count);
  std::uint32_t last = ~0u;
  for (std::uint32_t zone = 0; zone < Neighbourhood::kZones; ++zone) {
    const std::uint32_t first_ring = zone == 0 ? 0 : 1u << zone, end_ring = 2u << zone;
    if (first_ring > 0 && (first_ring - 1) * size_m_ - moved_m > asking.limit_m()) return;
    const std::uint32_t begin = n.ring[first_ring], end = n.ring[end_ring];
    if (begin == end) continue;
    const std::size_t buckets =
        kernel_->squares(n.buckets, begin, end, w, static_cast<float>(asking.limit_m()), room.buckets);
    for (std::size_t b = 0; b < buckets; ++b) {
      if (room.buckets.nearest_m[b] > asking.limit_m()) continue;
      const std::uint32_t bucket = room.buckets.name[b];
      const std::size_t count = kernel_->capsules(capsules_, n.buckets.begin[bucket], n.buckets.end[bucket], w,
                                                  static_cast<float>(asking.limit_m()), room.surfaces);
      sort(room.surfaces, count);
      for (std::size_t i = 0; i < count && room.surfaces.nearest_m[i] <= asking.limit_m(); ++i) {
        const std::uint32_t number = room.surfaces.name[i];
        if (number == last) continue;  // it passes through the bucket before, too
        asking.consider(seen_from(surfaces[number], apex), name_of(0, number));
        last = number;
      }
    }
  }
}

}  // namespace evigrid::raycast
