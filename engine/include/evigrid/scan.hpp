// SPDX-License-Identifier: Apache-2.0
// What comes in (a scan: the readings of one robot at one time) and what is told back (a report).
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "evigrid/export.hpp"
#include "evigrid/sensor.hpp"

namespace EVIGRID_API evigrid {

/// One sensor's measurement: one range for a cone, `Sensor::beams` ranges for a fan. REP 117: +inf = nothing in
/// range, −inf = too close, NaN = invalid.
struct Reading {
  SensorId sensor = 0;
  std::span<const float> ranges_m;  ///< m; read during the call alone
};

struct Scan {
  std::int64_t stamp_ns = 0;  ///< of any epoch, the same for all scans of a map
  Pose2 T_map_robot{};        ///< within 2^50 cells of the origin and 1e5 rad, else its ranges are refused
  std::span<const Reading> readings;
};

/// Why a range was not used. Each is counted, none is silent.
enum class Refusal : std::uint8_t {
  not_a_number,      ///< NaN
  too_close,         ///< −inf, 0, or below the sensor's min_range_m
  negative,          ///< below zero
  no_return,         ///< +inf, or at least the sensor's no_return_m
  above_max_range,   ///< a cone's reading beyond its max_range_m
  wrong_beam_count,  ///< a reading with another number of ranges than Sensor::beams (counted once)
  unknown_sensor,    ///< a sensor that was never added (counted once)
  pose_not_finite,   ///< the scan's pose, or one too far away to index (every range counted)
  false_reflection,  ///< a cone's reading that leaves its neighbours too far (MapParams::false_reflection_m)
};
inline constexpr int kRefusalCount = 9;
std::string_view name(Refusal) noexcept;

struct Report {
  std::uint64_t readings_used = 0;                     ///< ranges that updated the map
  std::array<std::uint64_t, kRefusalCount> refused{};  ///< by Refusal
  std::uint64_t readings_clipped = 0;                  ///< used ones that lay beyond max_range_m (fans)
  std::uint64_t stamps_backwards = 0;                  ///< scans older than the one before; still used
  std::uint64_t cells_updated = 0;                     ///< pairs of a reading (fan: a scan) and a cell
  std::uint64_t total_conflicts = 0;                   ///< updates answered by the total-conflict policy
  float max_conflict = 0;                              ///< largest k of one update
  CellRect touched{};                                  ///< box of tiles that accepted readings reached
  [[nodiscard]] std::uint64_t refused_total() const noexcept;
  Report& operator+=(const Report&) noexcept;  ///< sums; touched becomes the union
};

}  // namespace evigrid
