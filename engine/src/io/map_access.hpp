// SPDX-License-Identifier: Apache-2.0
// What saving and loading reach of a Map beyond its public face.
#pragma once
#include <cstdint>

#include "evigrid/map.hpp"
#include "evigrid/view.hpp"
#include "grid/admission.hpp"
#include "grid/change_log.hpp"
#include "grid/tile_store.hpp"

namespace evigrid {

class DeviceMap;
struct Pipeline;
struct Scratch;

struct MapAccess {
  /// With all cells at hand: what a device alone knew has come home. Throws std::runtime_error as Map::mass.
  static const TileSource& source(const Map&);
  static const TileSource& source(const MapView&) noexcept;
  static TileStore& store(Map&);
  static ChangeLog& changes(Map&) noexcept;
  static Admission& admission(Map&) noexcept;
  static const Admission& admission(const Map&) noexcept;
  static const Admission& admission(const MapView&) noexcept;
  static std::int64_t& last_stamp_ns(Map&) noexcept;  ///< the smallest number before the first scan
  static std::int64_t last_stamp_ns(const Map&) noexcept;
  static std::int64_t last_stamp_ns(const MapView&) noexcept;
  static Scratch& scratch(Map&) noexcept;
  static const Scratch& scratch(const Map&) noexcept;
  static Pipeline pipeline(Map&) noexcept;
  static void use_device(Map&, std::unique_ptr<DeviceMap>);  ///< for tests, with the emulated one
  static DeviceMap* device(Map&) noexcept;                   ///< null where there is none
  static Executor& executor(const Map&) noexcept;
};

}  // namespace evigrid
