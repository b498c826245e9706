// SPDX-License-Identifier: Apache-2.0
#include "journal/scan_order.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_set>

namespace evigrid {

OrderedScan* ScanOrder::find(ScanId id) noexcept {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : found->second;
}

OrderedScan& ScanOrder::at(ScanId id) {
  OrderedScan* const found = find(id);
  if (found == nullptr) throw std::out_of_range("RevisableMap: no scan has the id " + std::to_string(id));
  return *found;
}

std::size_t ScanOrder::place_of(const OrderedScan& s) const noexcept {
  const auto at = std::find_if(order_.begin(), order_.end(), [&](const auto& one) { return one.get() == &s; });
  return static_cast<std::size_t>(at - order_.begin());
}

ScanOrder::Place ScanOrder::place_for(std::int64_t stamp) const noexcept {
  Place out{order_.size()};
  if (stamp >= newest_stamp_ || reorder_ns_ <= 0) return out;
  if (ns_between(stamp, newest_stamp_) > static_cast<std::uint64_t>(reorder_ns_)) {
    out.too_late = true;
    return out;
  }
  for (std::size_t i = order_.size(); i > 0; --i) {
    const OrderedScan& before = *order_[i - 1];
    if (before.too_late) continue;  // its stamp says nothing of its place
    if (before.scan.stamp_ns <= stamp) break;
    out.at = i - 1;
  }
  return out;
}

OrderedScan& ScanOrder::insert(KeptScan scan, Place place) {
  auto one = std::make_unique<OrderedScan>();
  one->id = next_id_;
  one->too_late = place.too_late;
  one->scan = std::move(scan);
  OrderedScan& kept = *one;
  order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(place.at), std::move(one));
  by_id_[kept.id] = &kept;
  ++next_id_;
  newest_stamp_ = std::max(newest_stamp_, kept.scan.stamp_ns);
  return kept;
}

void ScanOrder::erase(OrderedScan& s) {
  put_on_tiles(s, {});
  by_id_.erase(s.id);
  order_.erase(order_.begin() + static_cast<std::ptrdiff_t>(place_of(s)));
}

void ScanOrder::put_on_tiles(OrderedScan& s, std::vector<TileIndex> tiles) {
  for (const TileIndex at : s.tiles) {
    auto& on = on_tile_[at];
    on.erase(std::find(on.begin(), on.end(), &s));
    if (on.empty()) on_tile_.erase(at);
  }
  s.tiles = std::move(tiles);
  for (const TileIndex at : s.tiles) on_tile_[at].push_back(&s);
}

void ScanOrder::forget_tiles() noexcept {
  on_tile_.clear();
  for (const auto& s : order_) s->tiles.clear();
}

const std::vector<const OrderedScan*>* ScanOrder::on(TileIndex at) const noexcept {
  const auto found = on_tile_.find(at);
  return found == on_tile_.end() ? nullptr : &found->second;
}

std::vector<Scan> ScanOrder::reaching(const TileSet& tiles, std::size_t from) const {
  std::unordered_set<const OrderedScan*> wanted;
  for (const TileIndex at : tiles) {
    if (const auto* scans = on(at)) wanted.insert(scans->begin(), scans->end());
  }
  std::vector<Scan> out;
  for (std::size_t i = from; i < order_.size(); ++i) {
    if (wanted.contains(order_[i].get())) out.push_back(order_[i]->scan.scan());
  }
  return out;
}

}  // namespace evigrid
