// SPDX-License-Identifier: Apache-2.0
// Tile by tile of `into`, in parallel; a cell meets one cell of `from`, so no order of tiles can matter.
#include "evigrid/merge.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "evigrid/combine.hpp"
#include "grid/admission.hpp"
#include "grid/cell_state.hpp"
#include "grid/decay.hpp"
#include "grid/readout.hpp"
#include "io/map_access.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid {
namespace {

constexpr int kSide = kernels::kTileSide, kCells = kernels::kMicroCells;
constexpr std::size_t kTileCells = std::size_t{kSide} * kSide;

/// Which cell of `from` a cell of `into` meets.
class Placement {
 public:
  Placement(const Pose2& pose, double cell_m) : x_(pose.x_m / cell_m), y_(pose.y_m / cell_m) {
    const auto turn = kernels::portable_sincos(pose.yaw_rad);
    sin_ = turn.sin, cos_ = turn.cos;
    const auto near_whole = [](double v) { return std::fabs(v - std::nearbyint(v)) < 1e-6; };
    aligned = pose.yaw_rad == 0 && near_whole(x_) && near_whole(y_);
    if (aligned) shift_ = {std::llrint(x_), std::llrint(y_)};
  }
  [[nodiscard]] CellIndex from(CellIndex into) const noexcept {
    if (aligned) return {into.x - shift_.x, into.y - shift_.y};
    const double dx = static_cast<double>(into.x) + 0.5 - x_, dy = static_cast<double>(into.y) + 0.5 - y_;
    return {static_cast<std::int64_t>(std::floor(cos_ * dx + sin_ * dy)),
            static_cast<std::int64_t>(std::floor(cos_ * dy - sin_ * dx))};
  }
  /// Cells of `into` around a tile of `from`.
  [[nodiscard]] CellRect around(TileIndex at) const noexcept {
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    for (int corner = 0; corner < 4; ++corner) {
      const double fx = static_cast<double>((at.x + corner % 2) * kSide),
                   fy = static_cast<double>((at.y + corner / 2) * kSide);
      const double x = cos_ * fx - sin_ * fy + x_, y = sin_ * fx + cos_ * fy + y_;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
    const auto low = [](double v) { return static_cast<std::int64_t>(std::floor(v)) - 1; };
    return {low(x0), low(y0), low(x1) - low(x0) + 3, low(y1) - low(y0) + 3};
  }
  bool aligned = false;

 private:
  double x_, y_, sin_, cos_;
  CellIndex shift_;
};

/// A map read at another time than its own.
class AsOf final : public TileSource {
 public:
  AsOf(const TileSource& map, std::int64_t at_ns) : TileSource(map.shared_layout()), map_(map) { now_ns = at_ns; }
  [[nodiscard]] const float* cells_of(TileIndex at) const noexcept override { return map_.cells_of(at); }
  [[nodiscard]] std::size_t size() const noexcept override { return map_.size(); }
  [[nodiscard]] std::vector<TileRef> in_order() const override { return map_.in_order(); }

 private:
  const TileSource& map_;
};

/// One tile of `into` and what it receives.
class TileMerge {
 public:
  TileMerge(const MapParams& params, const TileSource& into, const std::vector<CellRect>& guarded,
            const TileSource& from, Rule from_rule, const Placement& place, double reliability)
      : params_(params),
        into_(into),
        guarded_(guarded),
        from_(from),
        place_(place),
        reliability_(reliability),
        same_sums_(params.rule == from_rule && reliability == 1) {}

  [[nodiscard]] bool receives(TileIndex at) const {
    for (int i = 0; i < static_cast<int>(kTileCells); ++i) {
      const CellState s = incoming(at, i);
      if (!(s.mass == Mass{})) return true;
    }
    return false;
  }

  void run(Tile& tile, MergeReport& report, BlockMask& reached) const {
    std::vector<CellState> with;
    std::vector<int> cells;
    for (int i = 0; i < static_cast<int>(kTileCells); ++i) {
      CellState s = incoming(tile.index, i);
      if (s.mass == Mass{}) continue;
      cells.push_back(i), with.push_back(s);
      reached |= BlockMask{1} << (i / kSide / kBlockSide * kBlocksPerSide + i % kSide / kBlockSide);
    }
    report.cells += cells.size();
    if (into_.layout().planes_are_masses) {
      combine_masses(tile, cells, with, report);
    } else {
      join_states(tile, cells, with, report);
    }
  }

 private:
  [[nodiscard]] CellIndex cell_of_tile(TileIndex at, int i) const noexcept {
    return place_.from({at.x * kSide + i % kSide, at.y * kSide + i / kSide});
  }
  [[nodiscard]] CellState incoming(TileIndex at, int i) const { return read_cell(from_, cell_of_tile(at, i)); }
  [[nodiscard]] float* cell_at(const Tile& tile, int i) const noexcept {
    return tile.cells + into_.cell_offset(i % kSide, i / kSide);
  }
  void put(float* cell, const CellPlanes& s) const noexcept {
    for (int p = 0; p < into_.layout().state; ++p) cell[p * kCells] = s.at[p];
  }
  /// What a cell of `into` says now, where it forgets.
  [[nodiscard]] Mass present(const Tile& tile, int i) const noexcept {
    return read_cell(into_, {tile.index.x * kSide + i % kSide, tile.index.y * kSide + i / kSide}).mass;
  }
  [[nodiscard]] bool is_guarded(const Tile& tile, int i) const noexcept {
    const std::int64_t x = tile.index.x * kSide + i % kSide, y = tile.index.y * kSide + i / kSide;
    return std::any_of(guarded_.begin(), guarded_.end(), [&](const CellRect& r) {
      return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
    });
  }
  /// A cell that was joined is as of now, and is forgotten as fast as before, or as fast as where it came from. A
  /// protected one is not forgotten, not even where it still had an age: one of which nothing was left to freeze.
  void renew(const Tile& tile, int i, float* cell) const noexcept {
    if (into_.layout().age < 0) return;
    if (is_guarded(tile, i)) return set_age(into_.layout(), cell, {});
    CellAge age = age_of(into_.layout(), cell);
    if (age.tau_s == 0 && from_.layout().age >= 0) {
      const CellIndex at = cell_of_tile(tile.index, i);
      age.tau_s =
          age_of(from_.layout(), from_.cells_of(tile_of(at.x, at.y)) +
                                     from_.cell_offset(static_cast<int>(at.x & 63), static_cast<int>(at.y & 63)))
              .tau_s;
    }
    age.stamp_ns = into_.now_ns;
    set_age(into_.layout(), cell, age);
  }
  void add_history(float* cell, const CellState& from, float k, MergeReport& report) const noexcept {
    const CellLayout& l = into_.layout();
    if (l.conflict >= 0) cell[l.conflict * kCells] += from.conflict + k;
    if (l.con >= 0) cell[l.con * kCells] += from.con + weight_of_conflict(k);
    if (l.last_conflict >= 0) cell[l.last_conflict * kCells] = k;
    report.max_conflict = std::max(report.max_conflict, k);
  }
  [[nodiscard]] double believed(double part) const noexcept { return reliability_ * part; }

  void combine_masses(Tile& tile, const std::vector<int>& cells, const std::vector<CellState>& with,
                      MergeReport& report) const {
    const std::size_t n = cells.size();
    std::vector<double> a(4 * n), b(4 * n), k(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Mass mine = present(tile, cells[i]);
      a[i] = mine.e, a[n + i] = mine.o, a[2 * n + i] = mine.u, a[3 * n + i] = mine.c;
      const Mass& m = with[i].mass;
      b[i] = believed(m.e), b[n + i] = believed(m.o), b[3 * n + i] = believed(m.c);
      b[2 * n + i] = std::max(1 - reliability_ + believed(m.u), 0.0);
    }
    const auto planes = [&](std::vector<double>& v) {
      return Planes<double>{v.data(), v.data() + n, v.data() + 2 * n, v.data() + 3 * n};
    };
    const auto read = [&](std::vector<double>& v) {
      return Planes<const double>{v.data(), v.data() + n, v.data() + 2 * n, v.data() + 3 * n};
    };
    report.total_conflicts += combine(params_.rule, read(a), read(b), planes(a), k.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const Mass m{static_cast<float>(a[i]), static_cast<float>(a[n + i]), static_cast<float>(a[2 * n + i]),
                   static_cast<float>(a[3 * n + i])};
      float* const cell = cell_at(tile, cells[i]);
      put(cell, state_of(params_, m));
      renew(tile, cells[i], cell);
      add_history(cell, with[i], static_cast<float>(k[i]), report);
    }
  }

  void join_states(Tile& tile, const std::vector<int>& cells, const std::vector<CellState>& with,
                   MergeReport& report) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      float* const cell = cell_at(tile, cells[i]);
      CellPlanes mine, theirs;
      for (int p = 0; p < into_.layout().state; ++p) mine.at[p] = cell[p * kCells];
      if (same_sums_) {
        const CellIndex at = cell_of_tile(tile.index, cells[i]);
        const float* from = from_.cells_of(tile_of(at.x, at.y)) +
                            from_.cell_offset(static_cast<int>(at.x & 63), static_cast<int>(at.y & 63));
        for (int p = 0; p < into_.layout().state; ++p) theirs.at[p] = from[p * kCells];
      } else {
        Mass m = with[i].mass;
        m.u = static_cast<float>(1 - reliability_ + believed(m.u));
        m.e = static_cast<float>(believed(m.e)), m.o = static_cast<float>(believed(m.o)), m.c = 0;
        theirs = state_of(params_, m);
      }
      const Mass before = present(tile, cells[i]);
      const float k = static_cast<float>(believed(before.e) * with[i].mass.o + believed(before.o) * with[i].mass.e);
      put(cell, joined(params_, mine, theirs));
      add_history(cell, with[i], k, report);
    }
  }

  const MapParams& params_;
  const TileSource& into_;
  const std::vector<CellRect>& guarded_;
  const TileSource& from_;
  const Placement& place_;
  double reliability_;
  bool same_sums_;
};

void require_fit(const Map& into, const MapView& from, const MergeOptions& o) {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument("merge: " + why); };
  const Rule a = into.params().rule, b = from.params().rule;
  if (into.params().cell_m != from.params().cell_m) refuse("the maps have cells of different sizes");
  if (!(o.reliability > 0 && o.reliability <= 1)) refuse("reliability is not in (0, 1]");
  const double most = 1125899906842624.0 * into.params().cell_m;  // 2^50 cells
  const Pose2& p = o.T_into_from;
  if (!(std::fabs(p.x_m) < most && std::fabs(p.y_m) < most && std::fabs(p.yaw_rad) < 1e5))
    refuse("the pose is not finite or too far away");
  if ((same_as(a) == Rule::fuzzy) != (same_as(b) == Rule::fuzzy)) refuse("memberships (fuzzy) are no masses");
  const TileSource& grid = MapAccess::source(into);
  if (!grid.layout().planes_are_masses && a != Rule::fuzzy && keeps_paradox(b))
    refuse("the rule " + std::string(name(a)) + " has no place for the mass on empty and occupied that " +
           std::string(name(b)) + " keeps");
}

}  // namespace

MergeReport merge(Map& into, const MapView& from, const MergeOptions& options) {
  require_fit(into, from, options);
  TileStore& store = MapAccess::store(into);
  ChangeLog& changes = MapAccess::changes(into);
  const Admission& admission = MapAccess::admission(into);
  const std::int64_t now_ns = std::max(store.now_ns, MapAccess::source(from).now_ns);
  const AsOf source(MapAccess::source(from), now_ns);
  const Placement place(options.T_into_from, into.params().cell_m);
  const TileMerge merging(into.params(), store, admission.guarded, source, from.params().rule, place,
                          options.reliability);

  std::set<TileIndex> wanted;
  for (const TileRef& t : source.in_order()) {
    const TileRect r = tiles_of(place.around(t.at));
    for (std::int64_t y = r.first.y; y <= r.last.y; ++y) {
      for (std::int64_t x = r.first.x; x <= r.last.x; ++x) {
        if (!admission.window || admission.window->holds({y, x})) wanted.insert({y, x});
      }
    }
  }
  std::erase_if(wanted, [&](TileIndex at) { return !merging.receives(at); });
  std::size_t room = 0;
  store.begin_operation();
  for (const TileIndex at : wanted) {
    Tile* const tile = store.find(at);
    if (tile != nullptr) store.pin(*tile);
    room += static_cast<std::size_t>(tile == nullptr || store.seen(*tile));
  }
  store.reserve(room);

  struct Work {
    const TileMerge& merging;
    std::vector<Tile*> tiles;
    std::vector<MergeReport> reports;
    std::vector<BlockMask> reached;
  } work{merging, {}, {}, {}};
  for (const TileIndex at : wanted) {
    work.tiles.push_back(&store.get_or_make(at));
    store.own(*work.tiles.back());
  }
  work.reports.resize(work.tiles.size());
  work.reached.resize(work.tiles.size());
  store.now_ns = now_ns;  // from here on nothing throws but for want of memory
  MapAccess::executor(into).run(
      static_cast<std::int64_t>(work.tiles.size()),
      [](void* context, std::int64_t index, int) {
        Work& w = *static_cast<Work*>(context);
        const auto i = static_cast<std::size_t>(index);
        w.merging.run(*w.tiles[i], w.reports[i], w.reached[i]);
      },
      &work);
  MergeReport all;
  all.aligned = place.aligned;
  for (std::size_t i = 0; i < work.tiles.size(); ++i) {
    all.cells += work.reports[i].cells;
    all.total_conflicts += work.reports[i].total_conflicts;
    all.max_conflict = std::max(all.max_conflict, work.reports[i].max_conflict);
    work.tiles[i]->buffer->marks.mark(work.reached[i], changes.next());
    changes.moved(*work.tiles[i]);
  }
  if (!work.tiles.empty()) changes.commit();
  return all;
}

}  // namespace evigrid
