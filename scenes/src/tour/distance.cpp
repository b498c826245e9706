// SPDX-License-Identifier: Apache-2.0
#include "tour/distance.hpp"

#include <algorithm>

namespace evigrid::scenes {

std::vector<std::uint32_t> squared_distance(const TruthGrid& grid) {
  const std::int64_t w = grid.width, h = grid.height;
  const std::uint32_t none = kFarAway;
  std::vector<std::uint32_t> d(grid.cells.size(), none);
  const auto row_of = [&](std::int64_t y) { return d.data() + y * w; };

  // Along columns, a row at a time: distance to the surface cell below, then to the nearer of both.
  for (std::int64_t y = 0; y < h; ++y) {
    std::uint32_t* const row = row_of(y);
    const TruthCell* const cells = grid.cells.data() + y * w;
    for (std::int64_t x = 0; x < w; ++x) {
      const std::uint32_t below = y > 0 ? row[x - w] : none;
      row[x] = cells[x] == TruthCell::surface ? 0 : below == none ? none : below + 1;
    }
  }
  for (std::int64_t y = h - 2; y >= 0; --y) {
    std::uint32_t* const row = row_of(y);
    for (std::int64_t x = 0; x < w; ++x) {
      const std::uint32_t above = row[x + w];
      if (above != none) row[x] = std::min(row[x], above + 1);
    }
  }

  // Along each row: lower envelope of the parabolas (x − i)² + g(i)².
  struct Piece {
    std::int64_t centre, height, from;  // g(centre)²; lowest from x = from on
  };
  std::vector<Piece> pieces(static_cast<std::size_t>(w));
  for (std::int64_t y = 0; y < h; ++y) {
    std::uint32_t* const row = row_of(y);
    std::size_t count = 0;
    for (std::int64_t u = 0; u < w; ++u) {
      if (row[u] == none) continue;
      const std::int64_t height = std::int64_t{row[u]} * row[u];
      std::int64_t from = 0;
      while (count > 0) {
        const Piece& p = pieces[count - 1];
        const auto value = [&](std::int64_t centre, std::int64_t g) {
          return (p.from - centre) * (p.from - centre) + g;
        };
        if (value(p.centre, p.height) > value(u, height)) {  // nowhere the lowest
          --count;
          continue;
        }
        // The first x at which u is strictly lower; the quotient is not negative here.
        from = (u * u - p.centre * p.centre + height - p.height) / (2 * (u - p.centre)) + 1;
        break;
      }
      if (from < w) pieces[count++] = {u, height, from};
    }
    if (count == 0) continue;
    for (std::int64_t x = w - 1; x >= 0; --x) {
      const Piece& p = pieces[count - 1];
      row[x] = static_cast<std::uint32_t>(
          std::min<std::int64_t>((x - p.centre) * (x - p.centre) + p.height, std::int64_t{none}));
      if (x == p.from && count > 1) --count;
    }
  }
  return d;
}

}  // namespace evigrid::scenes
