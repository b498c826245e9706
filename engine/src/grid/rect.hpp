// SPDX-License-Identifier: Apache-2.0
// What rectangles callers may ask with: those whose sums and differences of coordinates cannot overflow, and whose
// cells have room in the caller's array.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "evigrid/types.hpp"

namespace evigrid {

/// No map reaches as far: poses beyond 2^50 cells are refused.
inline constexpr std::int64_t kFarthestCell = std::int64_t{1} << 60;

/// Corners within ±2^60 and sides of at most 2^61 cells.
inline bool is_near(const CellRect& r) noexcept {
  const auto far = [](std::int64_t v) { return v < -kFarthestCell || v > kFarthestCell; };
  return !far(r.x) && !far(r.y) && r.width <= 2 * kFarthestCell && r.height <= 2 * kFarthestCell;
}

/// Throws std::invalid_argument, its text beginning with `what`, for others.
inline void require_near(const char* what, const CellRect& r) {
  if (!is_near(r)) {
    throw std::invalid_argument(std::string(what) + ": the rectangle reaches beyond 2^60 cells");
  }
}

/// The same, and for an array of `size` values, a row every `stride`, that is shorter than the rectangle; not empty.
inline void require_room(const char* what, const CellRect& r, std::size_t size, std::ptrdiff_t stride) {
  require_near(what, r);
  std::size_t needed = 0;
  if (stride < r.width ||
      __builtin_mul_overflow(static_cast<std::size_t>(r.height - 1), static_cast<std::size_t>(stride), &needed) ||
      __builtin_add_overflow(needed, static_cast<std::size_t>(r.width), &needed) || size < needed) {
    throw std::invalid_argument(std::string(what) + ": the buffer is smaller than the rectangle");
  }
}

}  // namespace evigrid
