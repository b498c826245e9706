// SPDX-License-Identifier: Apache-2.0
// The evidential occupancy grid: sparse, tiled, without borders. One writer; const members may run together but never
// beside the others: who reads while the map fuses reads a view() (view.hpp). Never prints, aborts, or changes a
// process-wide setting. Calls throw what stands at them and, unless they are noexcept, std::bad_alloc.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "evigrid/executor.hpp"
#include "evigrid/export.hpp"
#include "evigrid/readout.hpp"
#include "evigrid/scan.hpp"
#include "evigrid/sensor.hpp"
#include "evigrid/types.hpp"

namespace EVIGRID_API evigrid {

/// How a reading's masses become the likelihoods that the rule bayes multiplies, by the share of m(unknown) in each:
/// betp a half (pignistic probability), plp all of it (plausibility; then bayes is the PlP of Dempster's rule).
enum class Likelihood : std::uint8_t { betp, plp };
std::string_view name(Likelihood) noexcept;
std::optional<Likelihood> likelihood_from_name(std::string_view) noexcept;

/// Used by the rule bayes alone, checked for all. A cell's probability of occupied stays within the limits, so that it
/// can still be turned.
struct BayesParams {
  Likelihood likelihood = Likelihood::betp;
  double least_p = 0.001;  ///< [1e-9, 0.5], and below most_p
  double most_p = 0.999;   ///< [0.5, 1 − 1e-9]
};

/// Ranges in brackets are what check() accepts.
struct MapParams {
  double cell_m = 0.05;               ///< side of a cell, m, [1e-4, 100]
  Rule rule = Rule::pcr5;             ///< combination rule of the whole map, one of map_rules()
  Kernel kernel = Kernel::automatic;  ///< which kernels run; one that kernel_available() has (combine.hpp)
  bool keep_conflict = true;          ///< a plane with the running sum of k
  bool keep_con = false;              ///< and one with −Σ ln(1 − k); only beside keep_conflict
  bool keep_last_conflict = false;    ///< and one with k of the last update; only beside keep_conflict
  BayesParams bayes{};
  /// Of the tiles, 16 KiB a plane each. What needs more throws std::length_error, but see page_to().
  std::size_t memory_cap_bytes = std::size_t{4} << 30;
  /// Filter of false reflections (Li et al. 2014): of three neighbours of a ring, in the order of their bearings, the
  /// third reading stays when |d3 − d2| < |d1 − d2| + this, m, [0, 1000]. Below 0: off.
  double false_reflection_m = -1;
  /// Forgetting: τ, s, 0 or [1e-3, 1e9]. A cell keeps exp(−Δt/τ) of its masses, Δt since the last reading that told it
  /// something, and what it gives up becomes unknown (Shafer's discount, by time). 0: nothing is forgotten. Sensors may
  /// have a τ of their own (Sensor::decay_s). Cells are read as they are at the last stamp; rules whose cells hold
  /// masses only. Costs three planes. Discounts in order: the reading's (contextual, then reliability), the cell's by
  /// time, then they are combined.
  double decay_s = 0;
};
/// Empty when the parameters are valid; every bad field otherwise. Whether the kernel runs here is not asked.
[[nodiscard]] std::vector<ParamError> check(const MapParams&);

/// How masses become costs of navigation, by BetP. As in ROS map_server, what lies above lethal_above is
/// occupied and what lies below free_below is free.
struct Costmap {
  double free_below = 0.196, lethal_above = 0.65;  ///< 0 ≤ free_below < lethal_above ≤ 1, which render() checks
  /// Cells with m(unknown) above it, never seen ones among them, hold no information. From 1 on: all cells hold some.
  double max_unknown = 0.9;
};
/// nav_msgs/OccupancyGrid: −1 no information, 0 free, 100 occupied, 1 … 99 linear in BetP between.
[[nodiscard]] std::int8_t occupancy_of(const Costmap&, const Mass&) noexcept;
/// costmap_2d: 255 NO_INFORMATION, 0 FREE_SPACE, 254 LETHAL_OBSTACLE, 1 … 252 linear in BetP between. 253, the
/// inscribed radius, is the inflation layer's to write.
[[nodiscard]] std::uint8_t cost_of(const Costmap&, const Mass&) noexcept;

/// What a consumer that holds a picture of the map has to draw again.
struct Changes {
  std::uint64_t version = 0;  ///< of the map now: what to ask with next time
  /// Nothing drawn before holds any more: the map was cleared since, or too much was dropped to be listed. `rects` then
  /// has all that is known.
  bool cleared = false;
  /// One for each tile that changed: those that were dropped, then the others, the last changed first. They do not
  /// overlap. Outside them no cell changed.
  std::vector<CellRect> rects;
};

class MapView;
struct EVIGRID_LOCAL MapAccess;  // of the library itself: saving and loading

class Map {
 public:
  /// Throws std::invalid_argument naming every bad field, or when the kernel asked for cannot run on this processor.
  /// Without an executor the map runs on TBB with all threads.
  explicit Map(const MapParams& = {}, std::shared_ptr<Executor> = nullptr);
  ~Map();
  Map(Map&&) noexcept;
  Map& operator=(Map&&) noexcept;

  /// Declares a sensor. Throws std::invalid_argument naming every bad field, a rule that cannot fuse its model, or a
  /// max_range_m of more than 65 536 cells.
  SensorId add(const Sensor&);

  /// Fuses scans in the order given. A scan that cannot be used is counted in the report; no cell is half updated.
  /// Throws std::length_error at the memory cap and std::system_error when a page file cannot be written, before any
  /// cell is changed. After a std::bad_alloc scans may be in some tiles and not in others.
  Report integrate(const Scan&);
  Report integrate(std::span<const Scan>);

  /// Takes scans back that were integrated before: the cells get the bits they would have without them, whatever
  /// readings came between. (Cells that were cleared, written or left by the window since hold nothing of them: where
  /// their tile is gone it makes none, elsewhere it takes away what is not there.) Rules whose cells are sums
  /// (dempster_log, murphy); throws std::logic_error for others. The planes of conflict keep what was met on the way,
  /// and the last stamp stays.
  Report undo(const Scan&);
  Report undo(std::span<const Scan>);

  /// Lets time pass without a scan: a map that forgets is read as it is then. Earlier times, and maps that do not
  /// forget, stay as they are. No change in the sense of changes(): whoever draws a forgetting map draws all that is in
  /// sight.
  void advance_to(std::int64_t stamp_ns) noexcept;

  // Reading cells. Any number of threads may do so at once while nothing changes the map. Throws nothing but what is
  // said, and std::runtime_error where the map is a GPU's and that was lost with cells of which the host has no copy.
  [[nodiscard]] Mass mass(CellIndex) const;            ///< vacuous where nothing was seen
  [[nodiscard]] float conflict(CellIndex) const;       ///< running sum of k, 0 without the plane
  [[nodiscard]] float con(CellIndex) const;            ///< −Σ ln(1 − k), 0 without the plane
  [[nodiscard]] float last_conflict(CellIndex) const;  ///< k of the last update, 0 without the plane
  /// Points beyond ±2^61 cells are answered by ±2^61, NaN by −2^61: nothing can be written there.
  [[nodiscard]] CellIndex cell_at(double x_m, double y_m) const noexcept;

  /// Smallest box around all non-vacuous cells.
  [[nodiscard]] CellRect bounds() const;
  /// Writes rect row by row, smallest y first, into out; row r starts at out[r·stride]. stride counts floats.
  /// Throws std::invalid_argument when out is too short, stride below the width, or rect reaches beyond 2^60 cells.
  void render(Layer, CellRect rect, std::span<float> out, std::ptrdiff_t stride, const ReadOutParams& = {}) const;
  /// The same with occupancy_of each cell. Throws std::invalid_argument too when not 0 ≤ free_below < lethal_above ≤ 1.
  void render(const Costmap&, CellRect rect, std::span<std::int8_t> out, std::ptrdiff_t stride) const;
  /// The same with cost_of each cell.
  void render(const Costmap&, CellRect rect, std::span<std::uint8_t> out, std::ptrdiff_t stride) const;

  /// Counts the calls that changed a cell, and clear(). 0: nothing yet.
  [[nodiscard]] std::uint64_t version() const noexcept;
  /// What changed after that version: within each tile of 64 × 64 cells the box of the 8 × 8 blocks that readings
  /// reached. Its cost grows with what changed, not with the map. Several consumers may each ask with their own
  /// version.
  [[nodiscard]] Changes changes(std::uint64_t since) const;

  /// Hash of (index, bits of e, o, u and, under the rules that keep one, c) of the non-vacuous cells in row-major
  /// order; independent of tiles and threads.
  [[nodiscard]] std::uint64_t hash() const;

  /// The map as it is now, for ever, for any number of threads (view.hpp). Costs what changed since the view before;
  /// afterwards each tile is copied once when it is first written again, as long as a view lives.
  [[nodiscard]] MapView view();

  /// Paging: when the cap is reached, the tiles that changed longest ago go to a file in that directory instead of an
  /// error. They are read there by everybody, views among them, and come back when something writes to them; no bit
  /// changes. The file has no name and goes with the process. What one call writes to must fit under the cap. Throws
  /// std::system_error naming the directory where the file cannot be made (or, from the calls that need room,
  /// written: before any cell is changed), std::logic_error when tiles are in such a file already, and
  /// std::invalid_argument where a tile is no whole number of the system's pages. As with swap, a disk that fails to
  /// give back what it holds ends the process (SIGBUS). Linux; elsewhere it throws.
  void page_to(const std::filesystem::path& directory);
  [[nodiscard]] std::size_t paged_bytes() const noexcept;  ///< of tiles in the page file; memory_bytes() has the others

  /// All cells and the last stamp go; parameters, sensors, window and protected areas stay.
  void clear();
  /// The cells of rect are as never seen, protected or not; tiles without any other cell are given back. Throws
  /// std::invalid_argument for a rect beyond 2^60 cells; where a tile that a view holds, or that was paged out, is
  /// cleared in part, as integrate(), before any cell is changed.
  void clear(CellRect rect);

  /// Rolling window: the map keeps the tiles of 64 × 64 cells that meet it, drops the others, and readings write
  /// nothing outside until it moves on. A shift costs the window's rows of tiles and what it drops, not the map. An
  /// empty rectangle: no window. Throws std::invalid_argument for one that reaches beyond 2^60 cells.
  void set_window(CellRect window);

  /// No reading changes these cells any more, no undo and no decay: they keep what they hold now, a map that was
  /// loaded, a room that is known. Whoever calls clear(), write() or merge() means it, and does. Reports still count
  /// the updates that were kept off in tiles that are protected in part. Costs readings nothing elsewhere. Throws
  /// std::invalid_argument for an area beyond 2^60 cells; in maps that forget as integrate(), and is then not
  /// protected.
  void protect(CellRect area);
  void unprotect();  ///< all areas
  [[nodiscard]] std::span<const CellRect> protected_areas() const noexcept;

  /// Says what is known without a sensor: the cells of rect get these masses, row by row from the smallest y, row r at
  /// masses[r·stride], and no history of conflict. A vacuous mass forgets the cell. In maps that
  /// forget, what is written fades only after a reading came to it. Under rules that keep no masses the
  /// cell is as after one source with that mass. A mass has parts within [0, 1] that add up to 1 within 1e-5 (fuzzy:
  /// memberships, which need not), c above 0 only where keeps_paradox(rule). Throws std::invalid_argument naming the
  /// cell whose mass is none, when masses is too short or stride below the width, and for a rect beyond 2^60 cells; and
  /// as integrate(), before any cell is changed.
  void write(CellRect rect, std::span<const Mass> masses, std::ptrdiff_t stride);
  /// A prior map as nav_msgs/OccupancyGrid has it: −1 leaves the cell alone, 0 … 100 is P(occupied) in percent, taken
  /// as m(occupied) = P·certainty, m(empty) = (1 − P)·certainty, certainty in (0, 1]. Throws as above, and
  /// std::invalid_argument for other values.
  void write(CellRect rect, std::span<const std::int8_t> occupancy, std::ptrdiff_t stride, double certainty);
  /// One mass in all cells whose centres lie in a convex polygon of frame M, its corners in either sense, e.g. a
  /// robot's footprint. Throws as above, and std::invalid_argument for fewer than three corners or one that is not
  /// within 2^50 cells of the origin.
  void write(std::span<const Point2> polygon, const Mass&);
  [[nodiscard]] const MapParams& params() const noexcept;
  [[nodiscard]] std::span<const Sensor> sensors() const noexcept;
  [[nodiscard]] std::string_view kernel_name()
      const noexcept;  ///< what really runs: "scalar", "avx2", "avx512", "cuda"
  /// Why the kernel asked for does not run, or runs no longer: a device that failed or ran out of memory. Mostly empty.
  [[nodiscard]] std::string_view kernel_note() const noexcept;
  [[nodiscard]] std::string_view executor_name() const noexcept;
  [[nodiscard]] std::span<const std::uint64_t> tiles_per_worker() const noexcept;  ///< tile tasks each worker ran
  [[nodiscard]] std::size_t tiles() const noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;  ///< of tiles, with those that only views still hold

 private:
  friend struct MapAccess;
  struct EVIGRID_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evigrid
