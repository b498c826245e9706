// SPDX-License-Identifier: Apache-2.0
// The evidential occupancy grid: sparse, tiled, without borders. One writer; const members may run together but never
// beside integrate(), clear() or add(). Never prints, aborts, or changes a process-wide setting.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "evigrid/executor.hpp"
#include "evigrid/scan.hpp"
#include "evigrid/sensor.hpp"
#include "evigrid/types.hpp"

namespace evigrid {

struct MapParams {
  double cell_m = 0.05;               ///< side of a cell
  Rule rule = Rule::pcr5;             ///< combination rule of the whole map
  Kernel kernel = Kernel::automatic;  ///< which kernels run
  bool keep_conflict = true;          ///< a plane with the running sum of k
  std::size_t memory_cap_bytes = std::size_t{4}
                                 << 30;  ///< of the tiles; integrate() throws std::length_error beyond it
};
[[nodiscard]] std::vector<ParamError> check(const MapParams&);

/// How masses become costs of navigation, by BetP = o + u/2. As in ROS map_server, what lies above lethal_above is
/// occupied and what lies below free_below is free.
struct Costmap {
  double free_below = 0.196, lethal_above = 0.65;
  double max_unknown = 0.9;  ///< cells with m(unknown) above it, never seen ones among them, hold no information
};
/// nav_msgs/OccupancyGrid: −1 no information, 0 free, 100 occupied, 1 … 99 linear in BetP between.
[[nodiscard]] std::int8_t occupancy_of(const Costmap&, const Mass&) noexcept;
/// costmap_2d: 255 NO_INFORMATION, 0 FREE_SPACE, 254 LETHAL_OBSTACLE, 1 … 252 linear in BetP between. 253, the
/// inscribed radius, is the inflation layer's to write.
[[nodiscard]] std::uint8_t cost_of(const Costmap&, const Mass&) noexcept;

/// What a consumer that holds a picture of the map has to draw again.
struct Changes {
  std::uint64_t version = 0;  ///< of the map now: what to ask with next time
  bool cleared = false;       ///< the map was cleared since: nothing drawn before holds any more
  /// One for each tile that changed, the last changed first; they do not overlap. Outside them no cell changed.
  std::vector<CellRect> rects;
};

struct MapAccess;  // of the library itself: saving and loading

class Map {
 public:
  /// Throws std::invalid_argument naming every bad field, or when the kernel asked for cannot run on this processor.
  /// Without an executor the map runs on TBB with all threads.
  explicit Map(const MapParams& = {}, std::shared_ptr<Executor> = nullptr);
  ~Map();
  Map(Map&&) noexcept;
  Map& operator=(Map&&) noexcept;

  /// Declares a sensor. Throws std::invalid_argument naming every bad field.
  SensorId add(const Sensor&);

  /// Fuses scans in the order given. A scan that cannot be used is counted in the report; no cell is half updated.
  Report integrate(const Scan&);
  Report integrate(std::span<const Scan>);

  [[nodiscard]] Mass mass(CellIndex) const noexcept;       ///< vacuous where nothing was seen
  [[nodiscard]] float conflict(CellIndex) const noexcept;  ///< running sum of k, 0 without the plane
  [[nodiscard]] CellIndex cell_at(double x_m, double y_m) const noexcept;

  /// Smallest box around all non-vacuous cells.
  [[nodiscard]] CellRect bounds() const;
  /// Writes rect row by row, smallest y first, into out; row r starts at out[r·stride]. stride counts floats.
  /// Throws std::invalid_argument when out is too short.
  void render(Layer, CellRect rect, std::span<float> out, std::ptrdiff_t stride) const;
  /// The same with occupancy_of each cell. Throws std::invalid_argument too when not 0 ≤ free_below < lethal_above ≤ 1.
  void render(const Costmap&, CellRect rect, std::span<std::int8_t> out, std::ptrdiff_t stride) const;
  /// The same with cost_of each cell.
  void render(const Costmap&, CellRect rect, std::span<std::uint8_t> out, std::ptrdiff_t stride) const;

  /// Counts the calls that changed a cell, and clear(). 0: nothing yet.
  [[nodiscard]] std::uint64_t version() const noexcept;
  /// What changed after that version: within each tile of 64 × 64 cells the box of the 8 × 8 blocks that readings
  /// reached. Its cost grows with what changed, not with the map. Several consumers may each ask with their own version.
  [[nodiscard]] Changes changes(std::uint64_t since) const;

  /// Hash of (index, bits of e, o, u) of the non-vacuous cells in row-major order; independent of tiles and threads.
  [[nodiscard]] std::uint64_t hash() const;

  void clear();
  [[nodiscard]] const MapParams& params() const noexcept;
  [[nodiscard]] std::span<const Sensor> sensors() const noexcept;
  [[nodiscard]] std::string_view kernel_name() const noexcept;  ///< what really runs: "scalar", "avx2", "avx512"
  [[nodiscard]] std::string_view executor_name() const noexcept;
  [[nodiscard]] std::span<const std::uint64_t> tiles_per_worker() const noexcept;  ///< tile tasks each worker ran
  [[nodiscard]] std::size_t tiles() const noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  friend struct MapAccess;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evigrid
