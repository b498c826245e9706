// SPDX-License-Identifier: Apache-2.0
// One tile as one zstd frame. Inside: the planes one after the other, cells row-major, smallest y first — not the
// kernels' layout, which may change. No arithmetic: any bits come back.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "grid/tile_source.hpp"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace evigrid::io {

class TileEncoder {  // one a worker
 public:
  TileEncoder();
  ~TileEncoder();
  TileEncoder(TileEncoder&&) noexcept = default;
  /// Empty when zstd fails, which only a lack of memory can make it do.
  std::vector<std::byte> encode(const TileSource&, const float* cells) noexcept;

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s*) const noexcept;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> zstd_;
  std::vector<std::byte> flat_, frame_;
};

class TileDecoder {  // one a worker
 public:
  TileDecoder();
  ~TileDecoder();
  TileDecoder(TileDecoder&&) noexcept = default;
  /// nullptr, or what is wrong with the block.
  const char* decode(const TileSource&, std::span<const std::byte> block, float* cells) noexcept;

 private:
  struct Free {
    void operator()(ZSTD_DCtx_s*) const noexcept;
  };
  std::unique_ptr<ZSTD_DCtx_s, Free> zstd_;
  std::vector<std::byte> flat_;
};

}  // namespace evigrid::io
