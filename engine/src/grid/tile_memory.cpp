// SPDX-License-Identifier: Apache-2.0
#include "grid/tile_memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace evigrid {
namespace {

constexpr std::size_t kBlock = PageFile::kExtent;

#ifdef __linux__
/// Mapped, not allocated: free() may keep what it is given, munmap does not.
float* map_block() {
  auto* const all =
      static_cast<char*>(mmap(nullptr, 2 * kBlock, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  if (all == MAP_FAILED) throw std::bad_alloc();
  char* const at = all + (kBlock - reinterpret_cast<std::uintptr_t>(all) % kBlock) % kBlock;
  if (at != all) munmap(all, static_cast<std::size_t>(at - all));
  if (at != all + kBlock) munmap(at + kBlock, static_cast<std::size_t>(all + kBlock - at));
  madvise(at, kBlock, MADV_HUGEPAGE);  // a wish: refused, the block is as good as any
  return reinterpret_cast<float*>(at);
}
void unmap_block(float* at) noexcept { munmap(at, kBlock); }
#else
float* map_block() {
  auto* const at = static_cast<float*>(std::aligned_alloc(kBlock, kBlock));
  if (at == nullptr) throw std::bad_alloc();
  return at;
}
void unmap_block(float* at) noexcept { std::free(at); }
#endif

}  // namespace

struct TileMemory::Block {
  float* base = nullptr;
  std::vector<std::uint32_t> free;  // places, taken from the end
  std::size_t places = 0;
  std::uint64_t extent = PageFile::kNone;  // where in the page file, as soon as a tile was paged

  explicit Block(std::size_t tile_bytes) : free(kBlock / tile_bytes), places(free.size()) {
    std::iota(free.rbegin(), free.rend(), 0u);
    base = map_block();
  }
  ~Block() { unmap_block(base); }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
};

TileMemory::TileMemory(std::size_t tile_bytes) : tile_bytes_(tile_bytes) {}
TileMemory::~TileMemory() = default;

TileMemory::Room TileMemory::take() {
  Room room;
  if (open_.empty() && ((in_use_ < kAlone && !file_) || tile_bytes_ > kBlock / 4)) {
    room.at = static_cast<float*>(std::aligned_alloc(64, tile_bytes_));
    if (room.at == nullptr) throw std::bad_alloc();
  } else {
    if (open_.empty()) {
      open_.reserve(blocks_.size() + 1);  // so that giving back never allocates
      blocks_.reserve(blocks_.size() + 1);
      blocks_.push_back(std::make_unique<Block>(tile_bytes_));
      open_.push_back(blocks_.back().get());
    }
    Block& block = *open_.back();
    if (&block == empty_) empty_ = nullptr;
    room = {block.base + block.free.back() * (tile_bytes_ / sizeof(float)), &block};
    block.free.pop_back();
    if (block.free.empty()) open_.pop_back();
  }
  ++in_use_;
  return room;
}

std::uint64_t TileMemory::place_in_file(const Room& room) const noexcept {
  return room.block->extent + static_cast<std::uint64_t>(room.at - room.block->base) * sizeof(float);
}

void TileMemory::page_to(const std::filesystem::path& directory) {
  if (!PageFile::possible(tile_bytes_))
    throw std::invalid_argument("tiles of " + std::to_string(tile_bytes_) + " bytes cannot be paged here");
  if (paged_ > 0) throw std::logic_error("there are tiles in a page file already");
  auto file = std::make_unique<PageFile>(directory);
  for (const auto& block : blocks_) block->extent = PageFile::kNone;
  file_ = std::move(file);
}

bool TileMemory::page_out(Room& room) {
  if (room.block == nullptr || room.paged) return false;
  if (room.block->extent == PageFile::kNone) room.block->extent = file_->take_extent();
  file_->page_out(room.at, tile_bytes_, place_in_file(room));
  room.paged = true;
  ++paged_;
  return true;
}

void TileMemory::give_back(Room room) noexcept {
  --in_use_;
  if (room.paged) {
    --paged_;
    if (!file_->take_back(room.at, tile_bytes_, place_in_file(room))) return;  // its place is lost, nothing else
  }
  if (room.block == nullptr) {
    std::free(room.at);
  } else {
    Block& block = *room.block;
    if (block.free.empty()) open_.push_back(&block);
    const auto offset = static_cast<std::size_t>(room.at - block.base);
    block.free.push_back(static_cast<std::uint32_t>(offset / (tile_bytes_ / sizeof(float))));  // within its first size
    if (block.free.size() == block.places) {
      if (empty_ != nullptr) release(empty_);
      empty_ = &block;
    }
  }
  if (in_use_ == 0 && empty_ != nullptr) release(empty_), empty_ = nullptr;
}

void TileMemory::release(Block* block) noexcept {
  if (block->extent != PageFile::kNone) file_->give_back_extent(block->extent);
  open_.erase(std::find(open_.begin(), open_.end(), block));
  blocks_.erase(std::find_if(blocks_.begin(), blocks_.end(), [&](const auto& b) { return b.get() == block; }));
}

}  // namespace evigrid
