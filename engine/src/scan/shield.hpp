// SPDX-License-Identifier: Apache-2.0
// Tiles that are protected in part: their protected cells are put back after each batch, bit for bit.
#pragma once
#include <vector>

#include "grid/admission.hpp"
#include "scan/bin.hpp"

namespace evigrid {

class Shield {
 public:
  Shield(const Plan&, const Admission&, const TileSource&);
  /// Puts the cells back, whatever came of the batch. A device does not have them then.
  ~Shield();
  Shield(const Shield&) = delete;
  Shield& operator=(const Shield&) = delete;

 private:
  struct Kept {
    float* at;
    float value;
  };
  std::vector<Kept> kept_;
  std::vector<Tile*> tiles_;
};

}  // namespace evigrid
