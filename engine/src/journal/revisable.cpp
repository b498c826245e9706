// SPDX-License-Identifier: Apache-2.0
// Scans in the order of fusion, and of each tile the scans that reached it. A change at a place of that order names
// tiles; they go back to the newest checkpoint before the place, and the scans behind it that reach one of them are
// fused on them again.
#include "evigrid/revisable.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "evigrid/combine.hpp"
#include "io/map_access.hpp"
#include "journal/recording.hpp"
#include "journal/scan_order.hpp"
#include "life/refuse.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kBatch = 128;

struct Checkpoint {
  std::size_t scans;  // it is the map after that many of the order
  MapView view;
};

/// f(all), or of its halves, and so on: in maps larger than their cap what one call writes to must fit under it. f
/// changes nothing when it throws std::length_error.
template <class T, class F>
void in_pieces(std::span<T> all, const F& f) {
  try {
    return f(all);
  } catch (const std::length_error&) {
    if (all.size() < 2) throw;
  }
  const std::size_t half = all.size() / 2;
  in_pieces(all.first(half), f);
  in_pieces(all.subspan(half), f);
}

}  // namespace

struct RevisableMap::Impl {
  Map map;
  RevisableOptions options;
  std::optional<Journal> journal;
  ScanOrder order;
  std::vector<Checkpoint> checkpoints;  // ascending; the first is before all scans and never goes
  std::int64_t stamp_before, checkpoint_stamp = ScanOrder::kNever;

  Impl(Map m, RevisableOptions o, std::optional<Journal> j)
      : map(std::move(m)), options(o), journal(std::move(j)), order(o.reorder_ns) {
    if (journal && map.tiles() > 0)
      throw std::invalid_argument("RevisableMap: a journal cannot say what the map held before its first scan");
    if (journal && MapAccess::admission(map).restricts())
      throw std::invalid_argument("RevisableMap: a journal cannot say that the map has a window or protected areas");
    checkpoints.push_back({0, map.view()});
    stamp_before = last_stamp(map);
  }
  [[nodiscard]] const MapView& before_all() const noexcept { return checkpoints.front().view; }

  /// Scans that belong behind all others: the ordinary case.
  Report append(std::span<const Scan> scans, bool too_late) {
    Report report;
    for (std::size_t first = 0; first < scans.size(); first += kBatch) {
      const auto batch = scans.subspan(first, std::min(kBatch, scans.size() - first));
      std::vector<KeptScan> kept(batch.begin(), batch.end());
      report += map.integrate(batch);
      auto reached = tiles_reached(map, batch.size());
      for (std::size_t i = 0; i < batch.size(); ++i)
        order.put_on_tiles(order.insert(std::move(kept[i]), {order.size(), too_late}), std::move(reached[i]));
      remember();
    }
    return report;
  }

  void remember() {
    if (options.checkpoint_every == 0) return;
    const bool many = order.size() - checkpoints.back().scans >= options.checkpoint_every;
    const bool long_ago =
        options.reorder_ns > 0 && order.size() > checkpoints.back().scans &&
        (checkpoint_stamp == ScanOrder::kNever ||
         ns_between(checkpoint_stamp, order.newest_stamp()) >= static_cast<std::uint64_t>(options.reorder_ns / 4));
    if (!many && !long_ago) return;
    checkpoints.push_back({order.size(), map.view()});
    checkpoint_stamp = order.newest_stamp();
    if (checkpoints.size() > options.most_checkpoints + 1) checkpoints.erase(checkpoints.begin() + 1);
  }

  /// Changes the scans behind `place` in their order, and fuses these tiles anew. Where there is no room for that
  /// std::length_error is thrown before anything is changed.
  template <class F>
  Revision revise(std::size_t place, const TileSet& tiles, const F& change) {
    while (checkpoints.back().scans > place) checkpoints.pop_back();
    const Checkpoint& from = checkpoints.back();
    try {
      put_back(map, tiles, from.view);
    } catch (...) {
      drop_empty(tiles);  // those that were made to see where a scan reaches
      throw;
    }
    change();
    const std::vector<Scan> scans = order.reaching(tiles, from.scans);
    for (std::size_t first = 0; first < scans.size(); first += kBatch)
      integrate_on(map, tiles, std::span(scans).subspan(first, std::min(kBatch, scans.size() - first)));
    drop_empty(tiles);
    put_stamp();
    return {tiles.size(), scans.size()};
  }
  /// Tiles in which nothing is left go, but for those that were there before all scans.
  void drop_empty(const TileSet& tiles) {
    TileSet gone;
    for (const TileIndex at : tiles) {
      if (!has_tile(before_all(), at) && (order.on(at) == nullptr || is_vacuous(map, at))) gone.insert(at);
    }
    drop_tiles(map, gone);
  }
  void put_stamp() {
    std::int64_t stamp = order.empty() ? stamp_before : order[order.size() - 1].scan.stamp_ns;
    if (map.params().decay_s > 0) {  // a map that forgets does not go back in time
      stamp = std::max(stamp, stamp_before);
      for (std::size_t i = 0; i < order.size(); ++i) stamp = std::max(stamp, order[i].scan.stamp_ns);
    }
    set_last_stamp(map, stamp);
  }

  Report sort_in(const Scan& s, ScanOrder::Place place) {
    Map alone(map.params(), make_serial_executor());  // what it says, without what is fused anew around it
    for (const Sensor& sensor : map.sensors()) alone.add(sensor);
    const Report report = alone.integrate(s);
    KeptScan kept(s);
    const auto reached = tiles_of_scan(map, s);
    revise(place.at, TileSet(reached.begin(), reached.end()),
           [&] { order.put_on_tiles(order.insert(std::move(kept), place), reached); });
    return report;
  }

  Added add(std::span<const Scan> scans) {
    Added out;
    out.first = order.next_id();
    Recording recording(journal);
    for (std::size_t i = 0; i < scans.size(); ++i)
      recording.record([&](Journal& j) { j.add(out.first + i, scans[i]); });
    try {
      fuse(scans, out);
    } catch (...) {
      recording.done(order.next_id() - out.first);
      throw;
    }
    recording.done(scans.size());
    return out;
  }
  void fuse(std::span<const Scan> scans, Added& out) {
    for (std::size_t i = 0; i < scans.size();) {
      // As many as come in their order are one batch.
      std::size_t end = i;
      std::int64_t newest = order.newest_stamp();
      while (end < scans.size() && (options.reorder_ns <= 0 || scans[end].stamp_ns >= newest))
        newest = std::max(newest, scans[end++].stamp_ns);
      if (end > i) {
        out.report += append(scans.subspan(i, end - i), false);
        i = end;
        continue;
      }
      const ScanOrder::Place place = order.place_for(scans[i].stamp_ns);
      const bool last = place.at == order.size();
      out.report += last ? append(scans.subspan(i, 1), place.too_late) : sort_in(scans[i], place);
      out.too_late += place.too_late;
      out.sorted_in += !last;
      ++i;
    }
  }

  /// What a journal tells, without fusing; false when it cannot be.
  bool replay(JournalEvent& e) {
    if (e.kind == JournalEvent::Kind::scan) {
      if (e.id < order.next_id()) return false;
      const ScanOrder::Place place = order.place_for(e.scan.stamp_ns);
      order.skip_to(e.id);
      order.insert(std::move(e.scan), place);
      return true;
    }
    OrderedScan* const known = order.find(e.id);
    if (known == nullptr) return false;
    if (e.kind == JournalEvent::Kind::move) {
      known->scan.T_map_robot = e.T_map_robot;
    } else {
      order.erase(*known);
    }
    return true;
  }

  Revision remove(ScanId id) {
    OrderedScan& s = order.at(id);
    Recording recording(journal);
    recording.record([&](Journal& j) { j.remove(id); });
    const TileSet tiles(s.tiles.begin(), s.tiles.end());
    return revise(order.place_of(s), tiles, [&] {
      order.erase(s);
      recording.done(1);
    });
  }

  Revision move(ScanId id, const Pose2& pose) {
    OrderedScan& s = order.at(id);
    Recording recording(journal);
    recording.record([&](Journal& j) { j.move(id, pose); });
    Scan moved = s.scan.scan();
    moved.T_map_robot = pose;
    const auto now = tiles_of_scan(map, moved);
    TileSet tiles(s.tiles.begin(), s.tiles.end());
    tiles.insert(now.begin(), now.end());
    return revise(order.place_of(s), tiles, [&] {
      s.scan.T_map_robot = pose;
      order.put_on_tiles(s, now);
      recording.done(1);
    });
  }

  Revision rebuild(std::span<const ScanPose> poses) {
    std::vector<ScanPose> before;
    for (const ScanPose& p : poses) before.push_back({p.id, order.at(p.id).scan.T_map_robot});
    Recording recording(journal);
    for (const ScanPose& p : poses) recording.record([&](Journal& j) { j.move(p.id, p.T_map_robot); });
    checkpoints.erase(checkpoints.begin() + 1, checkpoints.end());
    reserve_to_refuse(map, tiles_of_all());  // for the way back
    put_poses(poses);
    try {
      const Revision out = fuse_all();
      recording.done(poses.size());
      return out;
    } catch (...) {
      put_poses(before);
      fuse_all();
      throw;
    }
  }
  void put_poses(std::span<const ScanPose> poses) {
    for (const ScanPose& p : poses) order.at(p.id).scan.T_map_robot = p.T_map_robot;
  }
  /// So many tiles has the map when all is fused again as it is.
  [[nodiscard]] std::size_t tiles_of_all() const {
    const TileSet now = all_tiles(map);
    return order.tiles() + static_cast<std::size_t>(std::count_if(now.begin(), now.end(), [&](TileIndex at) {
             return has_tile(before_all(), at) && order.on(at) == nullptr;
           }));
  }
  Revision fuse_all() {
    std::vector<TileIndex> held;
    TileSet others;
    for (const TileIndex at : all_tiles(map)) {
      if (has_tile(before_all(), at)) {
        held.push_back(at);
      } else {
        others.insert(at);
      }
    }
    drop_tiles(map, others);
    in_pieces(std::span<const TileIndex>(held),
              [&](std::span<const TileIndex> some) { put_back(map, TileSet(some.begin(), some.end()), before_all()); });
    set_last_stamp(map, stamp_before);
    order.forget_tiles();
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < order.size(); ++i) scans.push_back(order[i].scan.scan());
    for (std::size_t first = 0; first < scans.size(); first += kBatch) {
      const std::span<const Scan> all(scans);
      in_pieces(all.subspan(first, std::min(kBatch, scans.size() - first)), [&](std::span<const Scan> batch) {
        map.integrate(batch);
        auto reached = tiles_reached(map, batch.size());
        const auto place = static_cast<std::size_t>(batch.data() - all.data());
        for (std::size_t i = 0; i < batch.size(); ++i) order.put_on_tiles(order[place + i], std::move(reached[i]));
      });
    }
    remember();
    return {map.tiles(), scans.size()};
  }
};

RevisableMap::RevisableMap(Map map, RevisableOptions options, std::optional<Journal> journal)
    : impl_(std::make_unique<Impl>(std::move(map), options, std::move(journal))) {}
RevisableMap::~RevisableMap() = default;
RevisableMap::RevisableMap(RevisableMap&&) noexcept = default;
RevisableMap& RevisableMap::operator=(RevisableMap&&) noexcept = default;

RevisableMap::Added RevisableMap::integrate(const Scan& scan) { return integrate(std::span<const Scan>(&scan, 1)); }
RevisableMap::Added RevisableMap::integrate(std::span<const Scan> scans) { return impl_->add(scans); }
RevisableMap::Revision RevisableMap::remove(ScanId id) { return impl_->remove(id); }
RevisableMap::Revision RevisableMap::move(ScanId id, const Pose2& pose) { return impl_->move(id, pose); }
RevisableMap::Revision RevisableMap::rebuild(std::span<const ScanPose> poses) { return impl_->rebuild(poses); }

RevisableMap RevisableMap::resume(const std::filesystem::path& path, const LoadOptions& load, RevisableOptions options,
                                  JournalOptions journal_options, std::uint64_t* dropped) {
  if (load.region)
    throw std::invalid_argument("RevisableMap::resume: scans cannot be fused in a region alone and go on in the whole");
  JournalContents was = read_journal(path);
  MapParams params = was.params;
  if (load.memory_cap_bytes) params.memory_cap_bytes = *load.memory_cap_bytes;
  params.kernel = load.kernel.value_or(kernel_available(params.kernel) ? params.kernel : Kernel::automatic);
  if (load.bytes_read != nullptr) *load.bytes_read = was.bytes + was.dropped;
  if (dropped != nullptr) *dropped = was.dropped;
  const auto fail = [&](const std::string& why) { throw MapFileError(path.string(), why); };
  try {
    Map map(params, load.executor);
    if (load.page_directory) map.page_to(*load.page_directory);
    for (const Sensor& sensor : was.sensors) map.add(sensor);
    RevisableMap out(std::move(map), options);
    for (JournalEvent& e : was.events) {
      if (!out.impl_->replay(e)) fail("names scan " + std::to_string(e.id) + ", which is not there or twice");
    }
    out.impl_->fuse_all();
    was.events.clear();
    out.impl_->journal = Journal::append(path, was, journal_options);
    return out;
  } catch (const std::invalid_argument& bad) {  // parameters or sensors that no map accepts
    fail(std::string("header: ") + bad.what());
    throw;
  }
}

const Map& RevisableMap::map() const noexcept { return impl_->map; }
MapView RevisableMap::view() { return impl_->map.view(); }
std::size_t RevisableMap::scans() const noexcept { return impl_->order.size(); }
std::size_t RevisableMap::bytes_of_scans() const noexcept {
  std::size_t out = 0;
  for (std::size_t i = 0; i < impl_->order.size(); ++i) {
    const OrderedScan& s = impl_->order[i];
    out += s.scan.bytes() + sizeof(s) + s.tiles.size() * sizeof(TileIndex);
  }
  return out;
}
std::vector<ScanPose> RevisableMap::poses() const {
  std::vector<ScanPose> out;
  for (std::size_t i = 0; i < impl_->order.size(); ++i)
    out.push_back({impl_->order[i].id, impl_->order[i].scan.T_map_robot});
  return out;
}

}  // namespace evigrid
