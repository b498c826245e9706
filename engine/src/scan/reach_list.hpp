// SPDX-License-Identifier: Apache-2.0
// Which tiles the readings of a chunk may touch. No reading asks what another one does, so any thread may list a chunk;
// what the lists say together is put in order afterwards (bin.hpp).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

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
  /// Compiles footprints first … end − 1, in their order. cones: by footprint.
  void list(std::span<Footprint> footprints, std::size_t first, std::size_t end, const kernels::KernelTable&,
            TileStore&, std::span<ConeFootprint> cones);
  [[nodiscard]] std::span<const Reached> reached() const noexcept { return reached_; }
  /// Of a cone that is listed here.
  [[nodiscard]] const kernels::ConeCuts* bands(const ConeFootprint& f) const noexcept { return cones_.bands(f); }

 private:
  void list_fan(std::uint32_t footprint, const kernels::Fan&, const kernels::KernelTable&, TileStore&);

  std::vector<Reached> reached_;
  ConeFootprints cones_;
  kernels::FanMicros fan_micros_;
};

}  // namespace evigrid
