// SPDX-License-Identifier: Apache-2.0
// A slow, separate map in double: every reading looks at every cell of its bounding box, decides membership exactly on
// the reading's lattice, computes the model by libm and fuses by the generic set algebra. Shares only the structs of
// the public API (and its pose composition) with the engine.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "evigrid/map.hpp"
#include "tests/oracle/reference_lattice.hpp"
#include "tests/oracle/reference_model.hpp"
#include "tests/oracle/reference_state.hpp"

namespace oracle {

struct ReferenceCell {
  double e = 0, o = 0, u = 1, c = 0;
  double conflict = 0;        ///< running sum of k
  double con = 0, last = 0;   ///< −Σ ln(1 − k), k of the last update
  StateNumbers state;         ///< of the rules whose state is not (e, o, u)
  std::uint64_t updates = 0;  ///< readings that touched the cell
  std::int64_t stamp_ns = 0;  ///< of the last of them; τ of its sensor (maps that forget)
  double tau_s = 0;
  [[nodiscard]] bool vacuous() const { return e == 0 && o == 0 && c == 0; }
};

struct CellHash {
  std::size_t operator()(const evigrid::CellIndex& c) const noexcept {
    const auto x = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ULL;
    const auto y = static_cast<std::uint64_t>(c.y) * 0xC2B2AE3D27D4EB4FULL;
    return static_cast<std::size_t>((x ^ (y >> 7)) + (y << 1));
  }
};
using ReferenceCells = std::unordered_map<evigrid::CellIndex, ReferenceCell, CellHash>;

/// What Report counts, except the box of tiles.
struct ReferenceReport {
  std::uint64_t readings_used = 0, readings_clipped = 0, stamps_backwards = 0, cells_updated = 0, total_conflicts = 0;
  std::array<std::uint64_t, evigrid::kRefusalCount> refused{};
  double max_conflict = 0;
};

class ReferenceMap {
 public:
  explicit ReferenceMap(const evigrid::MapParams& params) : params_(params) {}
  evigrid::SensorId add(const evigrid::Sensor&);
  void integrate(const evigrid::Scan&);
  [[nodiscard]] const ReferenceCells& cells() const { return cells_; }
  /// A cell as it is at the last stamp.
  [[nodiscard]] ReferenceCell now(const ReferenceCell&) const;
  [[nodiscard]] const ReferenceReport& report() const { return report_; }

 private:
  struct Declared {
    evigrid::Sensor sensor;
    Lattice lattice;
  };
  /// Tells of one centre, by its offset from the apex in cells, what the reading says; false: no update.
  using Say = std::function<bool(double dx, double dy, double d_squared, Source&)>;

  enum class Gate { use, clip, refuse };
  Gate gate(const evigrid::Sensor&, float range_m);
  void cone(const Declared&, const evigrid::Pose2&, float range_m);
  void fan(const Declared&, const evigrid::Pose2&, std::span<const float> ranges_m);
  void sweep(const Declared&, const evigrid::Pose2&, double radius_cells, const Say&);
  void update(ReferenceCell&, const Source&, const evigrid::Sensor&);
  void hear(const evigrid::CellIndex&, const Source&, const evigrid::Sensor&);
  [[nodiscard]] Source without_paradox(const Source&) const;
  void end_scan();
  void forget(ReferenceCell&, std::int64_t now_ns) const;

  evigrid::MapParams params_;
  std::vector<Declared> sensors_;
  ReferenceCells cells_;
  /// What dependent readings of the scan at hand said, by policy and cell: masses, and γ of their sensors.
  struct Heard {
    Source source;
    double exponent;
  };
  std::array<std::unordered_map<evigrid::CellIndex, std::vector<Heard>, CellHash>, 4> heard_;
  ReferenceReport report_;
  std::int64_t stamp_ns_ = 0;  ///< of the scan at hand
  std::int64_t last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace oracle
