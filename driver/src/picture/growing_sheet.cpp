// SPDX-License-Identifier: Apache-2.0
#include "picture/growing_sheet.hpp"

#include <algorithm>
#include <utility>

namespace evigrid::driver {
namespace {

CellRect around(const CellRect& a, const CellRect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const std::int64_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

}  // namespace

void GrowingSheet::add(const Layers& map) {
  around_all_ = around(around_all_, map.rect);
  made_.push_back({box(), thumbnail(map, sheet_scale(box(), panel_px_))});
}

std::vector<Thumbnail> GrowingSheet::finish(const std::function<Layers(std::size_t)>& again) {
  std::vector<Thumbnail> out;
  for (std::size_t i = 0; i < made_.size(); ++i) {
    Made& one = made_[i];
    if (one.shows != box()) one.picture = thumbnail(again(i), sheet_scale(box(), panel_px_));
    out.push_back(std::move(one.picture));
  }
  return out;
}

}  // namespace evigrid::driver
