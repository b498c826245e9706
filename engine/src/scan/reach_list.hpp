// SPDX-License-Identifier: Apache-2.0
// Which tiles the readings of a chunk may touch. No reading asks what another one does, so any thread may list a chunk;
// what the lists say together is put in order afterwards (bin.hpp).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "grid/admission.hpp"
#include "grid/tile_store.hpp"
#include "scan/compiled.hpp"
#include "scan/cone_list.hpp"

namespace evigrid {

/// A reading that may touch a tile.
struct Reached {
  std::uint32_t footprint;
  TileIndex at;
  Tile* tile;  // nullptr: there is none yet
};

class ReachList {
 public:
  /// Compiles footprints first … end − 1, in their order, and lists what they may touch, refused tiles among it where
  /// they exist or a cone asks. cones: by footprint.
  void list(std::span<Footprint> footprints, std::size_t first, std::size_t end, const kernels::KernelTable&,
            TileStore&, const Admission&, std::span<ConeFootprint> cones);
  [[nodiscard]] std::span<const Reached> reached() const noexcept { return reached_; }
  /// Of a cone that is listed here.
  [[nodiscard]] const kernels::ConeCuts* bands(const ConeFootprint& f) const noexcept { return cones_.bands(f); }

 private:
  void list_fan(std::uint32_t footprint, const kernels::Fan&, const kernels::KernelTable&, TileStore&,
                const Admission&);

  std::vector<Reached> reached_;
  ConeFootprints cones_;
  kernels::FanMicros fan_micros_;
  TileSet wanted_;  // missing tiles that a fan of the list reaches
};

}  // namespace evigrid
