// SPDX-License-Identifier: Apache-2.0
#include "scan/shield.hpp"

namespace evigrid {

Shield::Shield(const Plan& plan, const Admission& admission, const TileSource& source) {
  if (admission.guarded.empty()) return;
  for (const TileWork& w : plan.tiles) {
    for (const CellRect& area : admission.guarded) {
      const CellRect part = part_in(area, w.at);
      if (!part.empty()) tiles_.push_back(w.tile);
      for (std::int64_t y = part.y; y < part.y + part.height; ++y) {
        for (std::int64_t x = part.x; x < part.x + part.width; ++x) {
          float* const at = w.tile->cells + source.cell_offset(static_cast<int>(x), static_cast<int>(y));
          for (int p = 0; p < source.planes(); ++p)
            kept_.push_back({at + p * kernels::kMicroCells, at[p * kernels::kMicroCells]});
        }
      }
    }
  }
}

Shield::~Shield() {
  for (const Kept& k : kept_) *k.at = k.value;
  for (Tile* tile : tiles_) tile->device_version = kNoVersion;
}

}  // namespace evigrid
