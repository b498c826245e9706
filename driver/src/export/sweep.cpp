// SPDX-License-Identifier: Apache-2.0
#include "export/sweep.hpp"

#include <algorithm>
#include <vector>

namespace evigrid::driver {
namespace {

constexpr int kTileBits = 6;  // 64 × 64 cells

struct Piece {
  CellRect rect;
  std::vector<float> planes;  // the masses e, o, u, c, then those asked for
};

}  // namespace

void sweep(const Map& map, std::span<const Layer> layers,
           const std::function<void(CellIndex, std::span<const float>)>& cell,
           const std::function<void(std::size_t, std::size_t)>& done) {
  std::vector<CellRect> rects = map.changes(0).rects;  // what was ever touched, tile by tile
  std::sort(rects.begin(), rects.end(), [](const CellRect& a, const CellRect& b) {
    return std::pair(a.y >> kTileBits, a.x) < std::pair(b.y >> kTileBits, b.x);
  });
  std::vector<Layer> order{Layer::empty, Layer::bel, Layer::unknown, Layer::paradox};
  const std::size_t masses = order.size();
  order.insert(order.end(), layers.begin(), layers.end());
  std::vector<float> values(layers.size());
  std::vector<Piece> row;
  for (std::size_t at = 0; at < rects.size();) {
    const std::int64_t tile_y = rects[at].y >> kTileBits;
    row.clear();
    for (; at < rects.size() && rects[at].y >> kTileBits == tile_y; ++at) {
      Piece& piece = row.emplace_back(Piece{rects[at], {}});
      const auto n = static_cast<std::size_t>(piece.rect.width * piece.rect.height);
      piece.planes.resize(order.size() * n);
      for (std::size_t i = 0; i < order.size(); ++i)
        map.render(order[i], piece.rect, std::span(piece.planes).subspan(i * n, n), piece.rect.width);
    }
    for (std::int64_t y = tile_y * (1 << kTileBits); y < (tile_y + 1) * (1 << kTileBits); ++y) {
      for (const Piece& piece : row) {
        const CellRect& r = piece.rect;
        if (y < r.y || y >= r.y + r.height) continue;
        const auto n = static_cast<std::size_t>(r.width * r.height);
        for (std::int64_t x = 0; x < r.width; ++x) {
          const auto i = static_cast<std::size_t>((y - r.y) * r.width + x);
          const float* const p = piece.planes.data() + i;
          if (Mass{p[0], p[n], p[2 * n], p[3 * n]} == Mass{}) continue;
          for (std::size_t k = 0; k < values.size(); ++k) values[k] = p[(masses + k) * n];
          cell({r.x + x, y}, values);
        }
      }
    }
    done(at, rects.size());
  }
}

}  // namespace evigrid::driver
