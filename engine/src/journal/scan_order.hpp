// SPDX-License-Identifier: Apache-2.0
// The scans of a map that can change its mind: in the order of fusion, by id, and of each tile those that reached it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

#include "evigrid/journal.hpp"
#include "grid/admission.hpp"

namespace evigrid {

struct OrderedScan {
  ScanId id = 0;
  bool too_late = false;  // it stands where it came, not where its stamp belongs
  KeptScan scan;
  std::vector<TileIndex> tiles;  // that it reached
};

class ScanOrder {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
  struct Place {
    std::size_t at = 0;
    bool too_late = false;
  };

  /// reorder_ns: as in RevisableOptions.
  explicit ScanOrder(std::int64_t reorder_ns) : reorder_ns_(reorder_ns) {}

  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }
  [[nodiscard]] bool empty() const noexcept { return order_.empty(); }
  [[nodiscard]] OrderedScan& operator[](std::size_t place) noexcept { return *order_[place]; }
  [[nodiscard]] const OrderedScan& operator[](std::size_t place) const noexcept { return *order_[place]; }
  /// Null where there is none.
  [[nodiscard]] OrderedScan* find(ScanId) noexcept;
  /// Throws std::out_of_range.
  [[nodiscard]] OrderedScan& at(ScanId);
  [[nodiscard]] std::size_t place_of(const OrderedScan&) const noexcept;

  [[nodiscard]] ScanId next_id() const noexcept { return next_id_; }
  void skip_to(ScanId next) noexcept { next_id_ = next; }
  [[nodiscard]] std::int64_t newest_stamp() const noexcept { return newest_stamp_; }  ///< kNever before the first scan

  /// Where a scan of that stamp belongs: the end, unless it is late by less than the window.
  [[nodiscard]] Place place_for(std::int64_t stamp_ns) const noexcept;
  /// It gets the next id.
  OrderedScan& insert(KeptScan, Place);
  void erase(OrderedScan&);

  void put_on_tiles(OrderedScan&, std::vector<TileIndex>);
  void forget_tiles() noexcept;
  /// Scans that reached a tile, in no order; null where none did.
  [[nodiscard]] const std::vector<const OrderedScan*>* on(TileIndex) const noexcept;
  [[nodiscard]] std::size_t tiles() const noexcept { return on_tile_.size(); }  ///< that some scan reached
  /// From a place on those that reached one of the tiles, in their order.
  [[nodiscard]] std::vector<Scan> reaching(const TileSet&, std::size_t from) const;

 private:
  std::int64_t reorder_ns_, newest_stamp_ = kNever;
  ScanId next_id_ = 1;
  std::vector<std::unique_ptr<OrderedScan>> order_;
  std::unordered_map<ScanId, OrderedScan*> by_id_;
  std::unordered_map<TileIndex, std::vector<const OrderedScan*>, TileIndexHash> on_tile_;
};

/// From a stamp to one that is not before it; stamps may lie further apart than they can count.
inline std::uint64_t ns_between(std::int64_t from, std::int64_t to) noexcept {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

}  // namespace evigrid
