// SPDX-License-Identifier: Apache-2.0
// The kernel: a block per square of 16 × 16 cells and run of readings, a thread per cell. The block asks 256 readings
// at a time which of them may touch its square, keeps those in order, and every thread takes them one by one.
#pragma once
#include <cuda_runtime.h>

#include "kernels/device/device_cells.hpp"

EVIGRID_CELL_BEGIN

/// Sums over all threads of a batch.
struct DeviceCounts {
  unsigned long long cells, totals;
  unsigned max_k_bits;
};

struct LaunchArgs {
  const DeviceTile* tiles;
  const DevicePart* parts;
  unsigned part_count;
  const std::uint32_t* reaches;
  const ConeReading* cones;
  const FanReading* fans;
  const ReadingAge *cone_ages, *fan_ages;
  DeviceBatchArgs args;
  DeviceCounts* counts;
  unsigned long long* reached;
  cudaStream_t stream;
};

/// Model void: fans.
template <class State, class Model, bool kForgets>
__global__ void __launch_bounds__(kSquareCells) fuse_squares(const LaunchArgs l) {
  constexpr int kWarp = 32, kWarps = kSquareCells / kWarp;
  constexpr bool kFans = std::is_void_v<Model>;
  __shared__ std::uint32_t chosen[kSquareCells];
  __shared__ unsigned of_warp[kWarps];
  const DevicePart part = l.parts[blockIdx.x / kSquaresPerTile];
  const DeviceTile& tile = l.tiles[part.tile];
  const int square = static_cast<int>(blockIdx.x % kSquaresPerTile), thread = static_cast<int>(threadIdx.x);
  const int warp = thread / kWarp, lane = thread % kWarp;
  const Square16 at(tile, square);
  const Place place(thread);
  float* const cell = tile.cells + place.offset(square, l.args.planes);
  OwnCell<State, kForgets> own;
  bool loaded = false;
  for (std::uint32_t begin = 0; begin < part.count; begin += kSquareCells) {
    const std::uint32_t mine = begin + static_cast<std::uint32_t>(thread);
    std::uint32_t reading = 0;
    bool touches = false;
    if (mine < part.count) {
      reading = l.reaches[part.first + mine];
      if constexpr (kFans) {
        touches = may_touch(l.fans[reading], at);
      } else {
        touches = may_touch(l.cones[reading], at);
      }
    }
    const unsigned ballot = __ballot_sync(0xffffffffu, touches);
    if (lane == 0) of_warp[warp] = static_cast<unsigned>(__popc(ballot));
    __syncthreads();
    unsigned before = 0, all = 0;
    for (int w = 0; w < kWarps; ++w) {
      before += w < warp ? of_warp[w] : 0u;
      all += of_warp[w];
    }
    if (touches) chosen[before + static_cast<unsigned>(__popc(ballot & ((1u << lane) - 1u)))] = reading;
    __syncthreads();
    if (all > 0 && !loaded) {
      own.load(cell, l.args);
      loaded = true;
    }
    for (unsigned i = 0; i < all; ++i) {
      own.age.hears(kFans ? l.fan_ages : l.cone_ages, chosen[i]);
      if constexpr (kFans) {
        fuse_one(own, l.fans[chosen[i]], at, place, l.args);
      } else {
        fuse_one<Model>(own, l.cones[chosen[i]], at, place, l.args);
      }
    }
    __syncthreads();  // before `chosen` is written again
  }
  if (own.updates > 0) own.store(cell, l.args);
  // Counts: over the warp, then one addition a warp.
  const unsigned updates = __reduce_add_sync(0xffffffffu, own.updates),
                 totals = __reduce_add_sync(0xffffffffu, own.totals);
  const unsigned most = __reduce_max_sync(0xffffffffu, __float_as_uint(own.max_k));  // not negative: ordered as bits
  if (lane == 0 && updates > 0) {
    atomicAdd(&l.counts->cells, static_cast<unsigned long long>(updates));
    if (totals > 0) atomicAdd(&l.counts->totals, static_cast<unsigned long long>(totals));
    atomicMax(&l.counts->max_k_bits, most);
    atomicOr(&l.reached[part.tile], 1ull << block_of(square, place));  // a warp lies within one block of 8 × 8
  }
}

template <class State, class Model, bool kForgets>
void launch_cones(const LaunchArgs& l) {
  fuse_squares<State, Model, kForgets><<<l.part_count * kSquaresPerTile, kSquareCells, 0, l.stream>>>(l);
}
template <class State, bool kForgets>
void launch_fans(const LaunchArgs& l) {
  fuse_squares<State, void, kForgets><<<l.part_count * kSquaresPerTile, kSquareCells, 0, l.stream>>>(l);
}

EVIGRID_CELL_END

#include "kernels/device/device_table.hpp"

namespace evigrid::kernels::device {
// One group of rules a file, so that they compile side by side.
void fill_dempster_and_yager(DeviceTable&);
void fill_pcr(DeviceTable&);
void fill_pcr14(DeviceTable&);
void fill_states(DeviceTable&);
}  // namespace evigrid::kernels::device
