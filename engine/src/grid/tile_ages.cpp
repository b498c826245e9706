// SPDX-License-Identifier: Apache-2.0
#include "grid/tile_ages.hpp"

#include <algorithm>
#include <memory>

namespace evigrid {

TileAges::~TileAges() {
  for (TileBuffer* b : retired_) free(b);
}

TileBuffer* TileAges::make() {
  auto buffer = std::make_unique<TileBuffer>();
  const std::lock_guard lock(mutex_);
  retired_.reserve(memory_.in_use() + 1);  // so that retiring never allocates
  buffer->room = memory_.take();
  buffer->born = now_;
  return buffer.release();
}

void TileAges::retire(TileBuffer* buffer) noexcept {
  const std::lock_guard lock(mutex_);
  buffer->died = now_;
  if (seen_between(buffer->born, buffer->died)) {
    retired_.push_back(buffer);
  } else {
    free(buffer);
  }
}

std::size_t TileAges::page_out_retired(std::size_t most) {
  const std::lock_guard lock(mutex_);
  std::size_t n = 0;
  for (TileBuffer* b : retired_) {
    if (n == most) break;
    n += static_cast<std::size_t>(memory_.page_out(b->room));
  }
  return n;
}

std::uint64_t TileAges::open_view() {
  const std::lock_guard lock(mutex_);
  views_.push_back(now_);
  newest_.store(now_, std::memory_order_release);
  return now_++;
}

void TileAges::close_view(std::uint64_t age) noexcept {
  const std::lock_guard lock(mutex_);
  views_.erase(std::find(views_.begin(), views_.end(), age));
  newest_.store(views_.empty() ? 0 : views_.back(), std::memory_order_release);
  std::erase_if(retired_, [this](TileBuffer* b) {
    if (seen_between(b->born, b->died)) return false;
    free(b);
    return true;
  });
}

TileAges::Count TileAges::count() const {
  const std::lock_guard lock(mutex_);
  return {memory_.in_use() - memory_.paged(), memory_.paged()};
}

void TileAges::page_to(const std::filesystem::path& directory) {
  const std::lock_guard lock(mutex_);
  memory_.page_to(directory);
}

bool TileAges::page_out(TileBuffer* buffer) {
  const std::lock_guard lock(mutex_);
  return memory_.page_out(buffer->room);
}

bool TileAges::seen_between(std::uint64_t born, std::uint64_t died) const noexcept {
  const auto first = std::lower_bound(views_.begin(), views_.end(), born);
  return first != views_.end() && *first < died;
}

void TileAges::free(TileBuffer* buffer) noexcept {
  memory_.give_back(buffer->room);
  delete buffer;
}

}  // namespace evigrid
