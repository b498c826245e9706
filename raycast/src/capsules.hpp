// SPDX-License-Identifier: Apache-2.0
// The float half of the bucket index: many surfaces at once against one wedge, by whatever vectors the processor has.
// A capsule is a segment with a radius: a wall (radius 0), a circle (both ends its centre), the reach of a moving
// object. The kernels propose with a margin; doubles decide (wedge.hpp), so no answer depends on a kernel.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "wedge.hpp"

namespace evigrid::raycast {

/// Kernels read whole vectors: arrays are this much longer than what they hold, in and out.
inline constexpr std::size_t kSpare = 16;

/// Component by component, relative to an origin near by, so that floats keep what matters.
struct Capsules {
  std::vector<float> x0, y0, x1, y1, radius;
  std::vector<std::uint32_t> name;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(name.size() - kSpare); }
  void resize(std::size_t count);
  void set(std::size_t at, Vec2 a, Vec2 b, double radius_m, std::uint32_t n);
};

/// Squares of one size. `begin` and `end`: their capsules.
struct Squares {
  std::vector<float> x, y;  ///< centres
  std::vector<std::uint32_t> begin, end;
  float half_m = 0;
};

/// What a kernel found: names or numbers, each with a lower bound of its distance from the apex.
struct Proposals {
  std::vector<float> nearest_m;
  std::vector<std::uint32_t> name;
  void make_room(std::size_t count);
};

/// A wedge as the kernels see it: the apex relative to the origin of the capsules.
struct FloatWedge {
  float x, y, right_x, right_y, left_x, left_y;
  float margin_m;  ///< for all rounding of coordinates and products
};

struct CapsuleKernel {
  std::string_view target;
  /// Names of the capsules in [begin, end) that may have a point in the wedge within limit_m, written to `out`;
  /// returns how many.
  std::size_t (*capsules)(const Capsules& c, std::uint32_t begin, std::uint32_t end, const FloatWedge& w, float limit_m,
                          Proposals& out);
  /// The same for squares, by their numbers.
  std::size_t (*squares)(const Squares& s, std::uint32_t begin, std::uint32_t end, const FloatWedge& w, float limit_m,
                         Proposals& out);
};

/// The best one that this processor runs.
const CapsuleKernel& capsule_kernel();
/// By name: "scalar", "avx2", "avx512"; null when this processor does not run it.
const CapsuleKernel* find_capsule_kernel(std::string_view target);

const CapsuleKernel& scalar_capsule_kernel();
const CapsuleKernel& avx2_capsule_kernel();
const CapsuleKernel& avx512_capsule_kernel();

}  // namespace evigrid::raycast
