// SPDX-License-Identifier: Apache-2.0
// The second index: a grid of square buckets over the world, each with the surfaces that pass through it. For cones
// only, and for many of them: a bucket holds about a vector of surfaces, clipped at once (capsules.hpp). Like Embree's
// hierarchy it proposes, in float and with a margin; doubles decide.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "capsules.hpp"
#include "nearest_echo.hpp"
#include "surface.hpp"

namespace evigrid::raycast {

class BucketGrid {
 public:
  explicit BucketGrid(const std::vector<Surface>& surfaces, const CapsuleKernel& kernel = capsule_kernel());

  /// Surfaces in the bucket of an average surface. Where most of them crowd in few buckets a hierarchy is better.
  [[nodiscard]] double crowd() const { return crowd_; }

  /// The buckets that some cones of one neighbourhood may reach, from the inner to the outer ones: zone k begins at
  /// 2^k bucket widths from the centre.
  struct Neighbourhood {
    static constexpr int kZones = 8;
    Vec2 centre;
    Squares buckets;
    std::uint32_t zone[kZones + 1];  ///< zone k: buckets from zone[k] to zone[k + 1]
    std::vector<std::uint32_t> found, zone_of;
  };
  /// False when there are more buckets than are worth going through; then nothing is gathered.
  bool gather(Vec2 low, Vec2 high, Vec2 centre, Neighbourhood& out) const;

  /// What a search needs room for.
  struct Room {
    Proposals buckets, surfaces;
  };
  /// Asks `nearest` about every surface that may be within its limit. The wedge must lie in the neighbourhood's box.
  void search(const std::vector<Surface>& surfaces, const Neighbourhood& n, const Wedge& wedge, Vec2 apex,
              NearestEcho& nearest, Room& room) const;
  /// Numbers of all surfaces that may have a point in the wedge within limit_m, ascending.
  void collect(const Neighbourhood& n, const Wedge& wedge, Vec2 apex, double limit_m, Room& room,
               std::vector<std::uint32_t>& numbers) const;

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

}  // namespace evigrid::raycast
