// SPDX-License-Identifier: Apache-2.0
// Scans in the order of fusion, and of each tile the scans that reached it. A change at a place of that order names
// tiles; they go back to the newest checkpoint before the place, and the scans behind it that reach one of them are
// fused on them again.
#include "evigrid/revisable.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "evigrid/combine.hpp"
#include "life/refuse.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kBatch = 128;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();

struct Entry {
  ScanId id = 0;
  KeptScan scan;
  std::vector<TileIndex> tiles;  // that it reached
};
struct Checkpoint {
  std::size_t scans;  // it is the map after that many of the order
  MapView view;
};

}  // namespace

struct RevisableMap::Impl {
  Map map;
  RevisableOptions options;
  std::optional<Journal> journal;
  std::vector<std::unique_ptr<Entry>> order;
  std::unordered_map<ScanId, Entry*> by_id;
  std::unordered_map<TileIndex, std::vector<const Entry*>, TileIndexHash> on_tile;  // in no order
  std::vector<Checkpoint> checkpoints;  // ascending; the first is before all scans and never goes
  std::int64_t stamp_before, newest_stamp, checkpoint_stamp = kNever;
  ScanId next_id = 1;

  Impl(Map m, RevisableOptions o, std::optional<Journal> j) : map(std::move(m)), options(o), journal(std::move(j)) {
    if (journal && map.tiles() > 0)
      throw std::invalid_argument("RevisableMap: a journal cannot say what the map held before its first scan");
    checkpoints.push_back({0, map.view()});
    stamp_before = last_stamp(map);
    newest_stamp = kNever;
  }

  Entry& entry(ScanId id) {
    const auto found = by_id.find(id);
    if (found == by_id.end()) throw std::out_of_range("RevisableMap: no scan has the id " + std::to_string(id));
    return *found->second;
  }
  std::size_t place_of(const Entry& e) const {
    const auto at = std::find_if(order.begin(), order.end(), [&](const auto& one) { return one.get() == &e; });
    return static_cast<std::size_t>(at - order.begin());
  }
  void put_on_tiles(Entry& e, std::vector<TileIndex> tiles) {
    for (const TileIndex at : e.tiles) {
      auto& on = on_tile[at];
      on.erase(std::find(on.begin(), on.end(), &e));
      if (on.empty()) on_tile.erase(at);
    }
    e.tiles = std::move(tiles);
    for (const TileIndex at : e.tiles) on_tile[at].push_back(&e);
  }

  /// Where a scan of that stamp belongs: the end, unless it is late by less than the window.
  std::size_t place_for(std::int64_t stamp, bool& too_late) const {
    std::size_t at = order.size();
    too_late = false;
    if (stamp >= newest_stamp || options.reorder_ns <= 0) return at;
    if (newest_stamp - stamp > options.reorder_ns) {
      too_late = true;
      return at;
    }
    while (at > 0 && order[at - 1]->scan.stamp_ns > stamp) --at;
    return at;
  }

  /// Scans that belong behind all others: the ordinary case.
  Report append(std::span<const Scan> scans) {
    Report report;
    for (std::size_t first = 0; first < scans.size(); first += kBatch) {
      const auto batch = scans.subspan(first, std::min(kBatch, scans.size() - first));
      report += map.integrate(batch);
      auto reached = tiles_reached(map, batch.size());
      for (std::size_t i = 0; i < batch.size(); ++i)
        put_on_tiles(keep(KeptScan(batch[i]), order.size()), std::move(reached[i]));
      for (const Scan& s : batch) newest_stamp = std::max(newest_stamp, s.stamp_ns);
      remember();
    }
    return report;
  }
  Entry& keep(KeptScan scan, std::size_t place) {
    auto e = std::make_unique<Entry>();
    e->id = next_id++;
    e->scan = std::move(scan);
    Entry& kept = *e;
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(place), std::move(e));
    by_id[kept.id] = &kept;
    return kept;
  }

  void remember() {
    if (options.checkpoint_every == 0) return;
    const bool many = order.size() - checkpoints.back().scans >= options.checkpoint_every;
    const bool long_ago = options.reorder_ns > 0 && order.size() > checkpoints.back().scans &&
                          (checkpoint_stamp == kNever || newest_stamp - checkpoint_stamp >= options.reorder_ns / 4);
    if (!many && !long_ago) return;
    checkpoints.push_back({order.size(), map.view()});
    checkpoint_stamp = newest_stamp;
    if (checkpoints.size() > options.most_checkpoints + 1) checkpoints.erase(checkpoints.begin() + 1);
  }

  /// Fuses these tiles anew: what lies behind `place` in the order has changed.
  Revision revise(std::size_t place, const TileSet& tiles) {
    while (checkpoints.back().scans > place) checkpoints.pop_back();
    const Checkpoint& from = checkpoints.back();
    put_back(map, tiles, from.view);
    std::vector<const Entry*> again;
    for (const TileIndex at : tiles) {
      const auto on = on_tile.find(at);
      if (on != on_tile.end()) again.insert(again.end(), on->second.begin(), on->second.end());
    }
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    std::unordered_map<const Entry*, bool> wanted;
    for (const Entry* e : again) wanted[e] = true;
    std::vector<Scan> scans;
    for (std::size_t i = from.scans; i < order.size(); ++i) {
      if (wanted.contains(order[i].get())) scans.push_back(order[i]->scan.scan());
    }
    for (std::size_t first = 0; first < scans.size(); first += kBatch)
      integrate_on(map, tiles, std::span(scans).subspan(first, std::min(kBatch, scans.size() - first)));
    tidy(tiles);
    return {tiles.size(), scans.size()};
  }
  /// Tiles in which nothing is left go, but for those that were there before all scans.
  void tidy(const TileSet& tiles) {
    TileSet gone;
    const MapView& first = checkpoints.front().view;
    for (const TileIndex at : tiles) {
      if (!has_tile(first, at) && (!on_tile.contains(at) || is_vacuous(map, at))) gone.insert(at);
    }
    drop_tiles(map, gone);
    std::int64_t stamp = order.empty() ? stamp_before : order.back()->scan.stamp_ns;
    if (map.params().decay_s > 0) {  // a map that forgets does not go back in time
      for (const auto& e : order) stamp = std::max(stamp, e->scan.stamp_ns);
    }
    set_last_stamp(map, stamp);
  }

  Report sort_in(const Scan& s, std::size_t place) {
    const auto tiles = tiles_of_scan(map, s);
    Entry& e = keep(KeptScan(s), place);
    put_on_tiles(e, tiles);
    Map alone(map.params(), make_serial_executor());  // what it says, without what is fused anew around it
    for (const Sensor& sensor : map.sensors()) alone.add(sensor);
    const Report report = alone.integrate(s);
    revise(place, TileSet(tiles.begin(), tiles.end()));
    return report;
  }

  Added add(std::span<const Scan> scans, bool record) {
    Added out;
    out.first = next_id;
    if (record && journal) {
      for (std::size_t i = 0; i < scans.size(); ++i) journal->add(next_id + i, scans[i]);
    }
    for (std::size_t i = 0; i < scans.size();) {
      // As many as come in their order are one batch.
      std::size_t end = i;
      std::int64_t newest = newest_stamp;
      bool too_late = false;
      while (end < scans.size() && (options.reorder_ns <= 0 || scans[end].stamp_ns >= newest))
        newest = std::max(newest, scans[end++].stamp_ns);
      if (end > i) {
        out.report += append(scans.subspan(i, end - i));
        i = end;
        continue;
      }
      const std::size_t place = place_for(scans[i].stamp_ns, too_late);
      out.too_late += too_late;
      out.sorted_in += place < order.size();
      out.report += place == order.size() ? append(scans.subspan(i, 1)) : sort_in(scans[i], place);
      ++i;
    }
    return out;
  }

  /// What a journal tells, without fusing; false when it cannot be.
  bool replay(JournalEvent& e) {
    const auto known = by_id.find(e.id);
    if (e.kind == JournalEvent::Kind::scan) {
      if (e.id < next_id) return false;
      bool too_late = false;
      const std::int64_t stamp = e.scan.stamp_ns;
      const std::size_t place = place_for(stamp, too_late);
      next_id = e.id;
      keep(std::move(e.scan), place);
      newest_stamp = std::max(newest_stamp, stamp);
      return true;
    }
    if (known == by_id.end()) return false;
    if (e.kind == JournalEvent::Kind::move) {
      known->second->scan.T_map_robot = e.T_map_robot;
    } else {
      order.erase(order.begin() + static_cast<std::ptrdiff_t>(place_of(*known->second)));
      by_id.erase(known);
    }
    return true;
  }

  Revision remove(ScanId id) {
    Entry& e = entry(id);
    const std::size_t place = place_of(e);
    const TileSet tiles(e.tiles.begin(), e.tiles.end());
    put_on_tiles(e, {});
    by_id.erase(id);
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(place));
    return revise(place, tiles);
  }

  Revision move(ScanId id, const Pose2& pose) {
    Entry& e = entry(id);
    Scan moved = e.scan.scan();
    moved.T_map_robot = pose;
    const auto now = tiles_of_scan(map, moved);
    TileSet tiles(e.tiles.begin(), e.tiles.end());
    tiles.insert(now.begin(), now.end());
    e.scan.T_map_robot = pose;
    put_on_tiles(e, now);
    return revise(place_of(e), tiles);
  }

  Revision rebuild(std::span<const ScanPose> poses) {
    for (const ScanPose& p : poses) entry(p.id);
    std::vector<ScanPose> before;
    for (const ScanPose& p : poses) {
      before.push_back({p.id, entry(p.id).scan.T_map_robot});
      entry(p.id).scan.T_map_robot = p.T_map_robot;
    }
    try {
      return fuse_all();
    } catch (const std::length_error&) {
      std::reverse(before.begin(), before.end());
      for (const ScanPose& p : before) {
        entry(p.id).scan.T_map_robot = p.T_map_robot;
        if (journal) journal->move(p.id, p.T_map_robot);
      }
      fuse_all();
      throw;
    }
  }
  Revision fuse_all() {
    while (checkpoints.size() > 1) checkpoints.pop_back();
    TileSet held, others;
    for (const TileIndex at : all_tiles(map)) (has_tile(checkpoints.front().view, at) ? held : others).insert(at);
    drop_tiles(map, others);
    put_back(map, held, checkpoints.front().view);
    set_last_stamp(map, stamp_before);
    on_tile.clear();
    for (auto& e : order) e->tiles.clear();
    std::vector<Scan> scans;
    for (const auto& e : order) scans.push_back(e->scan.scan());
    for (std::size_t first = 0; first < scans.size(); first += kBatch) {
      const auto batch = std::span(scans).subspan(first, std::min(kBatch, scans.size() - first));
      map.integrate(batch);
      auto reached = tiles_reached(map, batch.size());
      for (std::size_t i = 0; i < batch.size(); ++i) put_on_tiles(*order[first + i], std::move(reached[i]));
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
RevisableMap::Added RevisableMap::integrate(std::span<const Scan> scans) { return impl_->add(scans, true); }

RevisableMap::Revision RevisableMap::remove(ScanId id) {
  impl_->entry(id);
  if (impl_->journal) impl_->journal->remove(id);
  return impl_->remove(id);
}
RevisableMap::Revision RevisableMap::move(ScanId id, const Pose2& pose) {
  impl_->entry(id);
  if (impl_->journal) impl_->journal->move(id, pose);
  return impl_->move(id, pose);
}
RevisableMap::Revision RevisableMap::rebuild(std::span<const ScanPose> poses) {
  for (const ScanPose& p : poses) impl_->entry(p.id);
  if (impl_->journal) {
    for (const ScanPose& p : poses) impl_->journal->move(p.id, p.T_map_robot);
  }
  return impl_->rebuild(poses);
}

RevisableMap RevisableMap::resume(const std::filesystem::path& path, const LoadOptions& load, RevisableOptions options,
                                  JournalOptions journal_options, std::uint64_t* dropped) {
  JournalContents was = read_journal(path);
  MapParams params = was.params;
  if (load.memory_cap_bytes) params.memory_cap_bytes = *load.memory_cap_bytes;
  params.kernel = load.kernel.value_or(kernel_available(params.kernel) ? params.kernel : Kernel::automatic);
  if (dropped != nullptr) *dropped = was.dropped;
  const auto fail = [&](const std::string& why) { throw MapFileError(path.string(), why); };
  try {
    Map map(params, load.executor);
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
  for (const auto& e : impl_->order) out += e->scan.bytes() + sizeof(Entry) + e->tiles.size() * sizeof(TileIndex);
  return out;
}
std::vector<ScanPose> RevisableMap::poses() const {
  std::vector<ScanPose> out;
  for (const auto& e : impl_->order) out.push_back({e->id, e->scan.T_map_robot});
  return out;
}

}  // namespace evigrid
