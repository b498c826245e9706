// SPDX-License-Identifier: Apache-2.0
// The CUDA device. Plain allocations, every call checked. A batch goes up in one block of pinned memory; kernels run on
// one stream. Cells that the host asks for are gathered and come back on another, piece by piece, while the host takes
// the first ones.
#include <algorithm>
#include <cstring>
#include <vector>

#include "kernels/device/cuda_check.hpp"
#include "kernels/device/cuda_dense.hpp"
#include "kernels/device/cuda_launch.cuh"

namespace evigrid::kernels {
namespace {

using device::DeviceCounts;

/// Copies tiles: one block each, `many` side by side on one end, by pointers on the other.
__global__ void gather_tiles(const float* const* tiles, float4* many, unsigned vectors) {
  const auto* from = reinterpret_cast<const float4*>(tiles[blockIdx.x]);
  float4* to = many + static_cast<std::size_t>(blockIdx.x) * vectors;
  for (unsigned i = threadIdx.x; i < vectors; i += blockDim.x) to[i] = from[i];
}
__global__ void scatter_tiles(float* const* tiles, const float4* many, unsigned vectors) {
  auto* to = reinterpret_cast<float4*>(tiles[blockIdx.x]);
  const float4* from = many + static_cast<std::size_t>(blockIdx.x) * vectors;
  for (unsigned i = threadIdx.x; i < vectors; i += blockDim.x) to[i] = from[i];
}

/// A block a tile, a thread a micro-tile.
__global__ void tile_costs(const CostArgs args, const float* const* tiles, int planes, std::uint8_t* out) {
  device::costs_of_micro(args, tiles[blockIdx.x], planes, static_cast<int>(threadIdx.x),
                         out + static_cast<std::size_t>(blockIdx.x) * kTileSide * kTileSide);
}

class Stream {
 public:
  Stream() { cuda_check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "stream"); }
  ~Stream() { (void)cudaStreamDestroy(stream_); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  operator cudaStream_t() const noexcept { return stream_; }

 private:
  cudaStream_t stream_ = nullptr;
};

/// One block of bytes, written on the host piece by piece, sent at once.
class Parcel {
 public:
  void begin(std::size_t most) {
    host_.room<std::byte>(most);
    device_.room<std::byte>(most);
    used_ = 0;
  }
  /// A copy of the array: where it will be on the device.
  template <class T>
  T* add(const T* from, std::size_t count) {
    T* const to = on_host<T>(count);
    if (count > 0) std::memcpy(static_cast<void*>(to), from, count * sizeof(T));
    return on_device(to);
  }
  template <class T>
  T* on_host(std::size_t count) {
    used_ = (used_ + 255) / 256 * 256;
    T* const at = reinterpret_cast<T*>(host_.get<std::byte>() + used_);
    used_ += count * sizeof(T);
    return at;
  }
  template <class T>
  T* on_device(T* on_host) const {
    return reinterpret_cast<T*>(device_.get<std::byte>() +
                                (reinterpret_cast<std::byte*>(on_host) - host_.get<std::byte>()));
  }
  void send(cudaStream_t s) {
    cuda_check(cudaMemcpyAsync(device_.get<std::byte>(), host_.get<std::byte>(), used_, cudaMemcpyHostToDevice, s),
               "upload");
  }

 private:
  CudaBuffer<true> host_;
  CudaBuffer<false> device_;
  std::size_t used_ = 0;
};

class Cuda final : public Device {
 public:
  Cuda() {
    cuda_check(cudaSetDevice(0), "device 0");
    cudaDeviceProp p{};
    cuda_check(cudaGetDeviceProperties(&p, 0), "properties");
    name_ = p.name;
    device::fill_dempster_and_yager(table_);
    device::fill_pcr(table_);
    device::fill_pcr14(table_);
    device::fill_states(table_);
  }
  ~Cuda() override { Cuda::release(); }
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] DeviceTimes times() const override { return times_; }

  float* take(std::size_t bytes) override {
    if (left_ < bytes) {
      const std::size_t slab = std::max<std::size_t>(bytes, std::size_t{64} << 20);
      void* at = nullptr;
      cuda_check(cudaMalloc(&at, slab), "memory for tiles");
      slabs_.push_back(at);
      next_ = static_cast<std::byte*>(at), left_ = slab;
    }
    float* const tile = reinterpret_cast<float*>(next_);
    next_ += bytes, left_ -= bytes;
    return tile;
  }
  void release() noexcept override {
    for (void* slab : slabs_) (void)cudaFree(slab);
    slabs_.clear();
    next_ = nullptr, left_ = 0;
  }

  DeviceResult fuse(const DeviceBatch& b) override {
    const std::size_t floats = static_cast<std::size_t>(kTileSide * kTileSide * b.planes);
    const std::size_t tiles = b.tiles.size();
    auto* const counts = counts_host_.room<DeviceCounts>(1);
    auto* const reached = reached_host_.room<unsigned long long>(tiles);
    reached_.resize(tiles);
    upload(b, floats);
    try {
      run(b, *counts, reached);
    } catch (const DeviceError& failed) {  // some of its kernels may have run
      throw DeviceLost(failed.what());
    }
    DeviceResult out;
    float most = 0;
    std::memcpy(&most, &counts->max_k_bits, sizeof most);
    out.stats = {counts->cells, counts->totals, most};
    std::copy_n(reached, tiles, reached_.begin());
    out.reached = reached_;
    return out;
  }

  const float* fetch(std::span<const float* const> tiles, std::size_t floats) override {
    coming_ = tiles.size();
    pieces_ = (coming_ + kPiece - 1) / kPiece;
    if (coming_ == 0) return nullptr;
    while (piece_done_.size() < pieces_) piece_done_.push_back(std::make_unique<CudaEvent>());
    auto* const host = back_host_.room<float>(coming_ * floats);
    auto* const gathered = back_device_.room<float>(coming_ * floats);
    const float* const* const list = list_of(tiles);
    fetching_.record(back_stream_);
    for (std::size_t i = 0; i < pieces_; ++i) {
      const std::size_t first = i * kPiece, n = std::min(kPiece, coming_ - first);
      gather_tiles<<<static_cast<unsigned>(n), 256, 0, back_stream_>>>(
          list + first, reinterpret_cast<float4*>(gathered + first * floats), static_cast<unsigned>(floats / 4));
      cuda_check(cudaGetLastError(), "launch");
      cuda_check(cudaMemcpyAsync(host + first * floats, gathered + first * floats, n * floats * sizeof(float),
                                 cudaMemcpyDeviceToHost, back_stream_),
                 "download");
      piece_done_[i]->record(back_stream_);
    }
    return host;
  }

  void arrived(std::size_t tiles) override {
    if (tiles > 0) piece_done_[std::min((tiles - 1) / kPiece, pieces_ - 1)]->wait();
    if (tiles == coming_ && tiles > 0) times_.download_s = piece_done_[pieces_ - 1]->since(fetching_);
  }

  const std::uint8_t* costs(const CostArgs& args, std::span<const float* const> tiles, int planes) override {
    static_assert(kMicrosPerTile <= 1024, "a thread a micro-tile");
    if (tiles.empty()) return nullptr;
    const std::size_t bytes = tiles.size() * kTileSide * kTileSide;
    auto* const host = costs_host_.room<std::uint8_t>(bytes);
    auto* const there = costs_device_.room<std::uint8_t>(bytes);
    const float* const* const list = list_of(tiles);
    tile_costs<<<static_cast<unsigned>(tiles.size()), kMicrosPerTile, 0, back_stream_>>>(args, list, planes, there);
    cuda_check(cudaGetLastError(), "launch");
    cuda_check(cudaMemcpyAsync(host, there, bytes, cudaMemcpyDeviceToHost, back_stream_), "download");
    cuda_check(cudaStreamSynchronize(back_stream_), "costs");
    return host;
  }

  std::uint64_t combine(int rule, const DensePlanes& p, std::size_t n) override {
    const std::size_t bytes = n * sizeof(float);
    float* const at = arrays_.room<float>(8 * n + 2);
    DensePlanes on{at, at + n, at + 2 * n, at + 3 * n, at + 4 * n, at + 5 * n,
                   at, at + n, at + 2 * n, at + 6 * n, at + 7 * n};
    auto* const totals = counts_.room<unsigned long long>(sizeof(DeviceCounts) / sizeof(unsigned long long) + 1);
    const float* const from[6] = {p.ae, p.ao, p.au, p.be, p.bo, p.bu};
    sent_.record(work_);
    for (std::size_t i = 0; i < 6; ++i)
      cuda_check(cudaMemcpyAsync(at + i * n, from[i], bytes, cudaMemcpyHostToDevice, work_), "upload");
    cuda_check(cudaMemsetAsync(totals, 0, sizeof *totals, work_), "count");
    if (p.k == nullptr) on.k = nullptr;
    if (p.cc == nullptr) on.cc = nullptr;
    started_.record(work_);
    device::dense_on_device(rule, on, n, totals, work_);
    cuda_check(cudaGetLastError(), "launch");
    fused_.record(work_);
    float* const to[5] = {p.ce, p.co, p.cu, p.k, p.cc};
    const float* const result[5] = {on.ce, on.co, on.cu, on.k, on.cc};
    const bool leaves_paradox = rule == kConjunctive || rule == kFuzzy;
    for (int i = 0; i < 5; ++i) {
      if (to[i] == nullptr || (i == 4 && !leaves_paradox)) continue;
      cuda_check(cudaMemcpyAsync(to[i], result[i], bytes, cudaMemcpyDeviceToHost, work_), "download");
    }
    unsigned long long total = 0;
    cuda_check(cudaMemcpyAsync(&total, totals, sizeof total, cudaMemcpyDeviceToHost, work_), "count");
    back_.record(work_);
    cuda_check(cudaStreamSynchronize(work_), "combination");
    times_ = {started_.since(sent_), fused_.since(started_), back_.since(fused_)};
    return total;
  }

  double copy_rate(std::size_t bytes) override {
    auto* const at = arrays_.room<std::byte>(2 * bytes);
    double best = 1e9;
    for (int i = 0; i < 8; ++i) {
      started_.record(work_);
      cuda_check(cudaMemcpyAsync(at + bytes, at, bytes, cudaMemcpyDeviceToDevice, work_), "copy");
      fused_.record(work_);
      fused_.wait();
      best = std::min(best, fused_.since(started_));
    }
    return 2 * static_cast<double>(bytes) / best;
  }

 private:
  static constexpr std::size_t kPiece = 256;  // tiles that come back at a time

  void upload(const DeviceBatch& b, std::size_t floats) {
    std::size_t new_tiles = 0, fan_floats = 0;
    for (const DeviceTile& t : b.tiles) new_tiles += t.host != nullptr;
    for (const Fan* f : b.fans) fan_floats += 3 * static_cast<std::size_t>(f->reading.beams) + 2;
    const std::size_t bytes = b.tiles.size_bytes() + b.parts.size_bytes() + b.reaches.size_bytes() +
                              b.cones.size() * sizeof(ConeReading) + b.fans.size() * sizeof(FanReading) +
                              b.cone_ages.size_bytes() + b.fan_ages.size_bytes() +
                              fan_floats * sizeof(float) + new_tiles * (floats + 2) * sizeof(float);
    parcel_.begin(bytes + 256 * (16 + 3 * b.fans.size()));
    sent_.record(work_);
    args_.tiles = parcel_.add(b.tiles.data(), b.tiles.size());
    args_.parts = parcel_.add(b.parts.data(), b.parts.size());
    args_.reaches = parcel_.add(b.reaches.data(), b.reaches.size());
    auto* const cones = parcel_.on_host<ConeReading>(b.cones.size());
    for (std::size_t i = 0; i < b.cones.size(); ++i) cones[i] = *b.cones[i];
    args_.cones = parcel_.on_device(cones);
    auto* const fans = parcel_.on_host<FanReading>(b.fans.size());
    for (std::size_t i = 0; i < b.fans.size(); ++i) {
      const FanReading& q = b.fans[i]->reading;
      const auto beams = static_cast<std::size_t>(q.beams);
      fans[i] = q;
      fans[i].range = parcel_.add(q.range, beams);
      fans[i].border_x = parcel_.add(q.border_x, beams + 1);
      fans[i].border_y = parcel_.add(q.border_y, beams + 1);
      fans[i].reach = nullptr;
    }
    args_.fans = parcel_.on_device(fans);
    args_.cone_ages = parcel_.add(b.cone_ages.data(), b.cone_ages.size());
    args_.fan_ages = parcel_.add(b.fan_ages.data(), b.fan_ages.size());
    auto** const places = parcel_.on_host<float*>(new_tiles);
    auto* const cells = parcel_.on_host<float>(new_tiles * floats);
    std::size_t n = 0;
    for (const DeviceTile& t : b.tiles) {
      if (t.host == nullptr) continue;
      std::memcpy(cells + n * floats, t.host, floats * sizeof(float));
      places[n++] = t.cells;
    }
    parcel_.send(work_);
    if (new_tiles > 0) {
      scatter_tiles<<<static_cast<unsigned>(new_tiles), 256, 0, work_>>>(
          parcel_.on_device(places), reinterpret_cast<const float4*>(parcel_.on_device(cells)),
          static_cast<unsigned>(floats / 4));
      cuda_check(cudaGetLastError(), "launch");
    }
    args_.args = {b.planes, b.age, b.conflict_plane, b.args};
    args_.counts = counts_.room<DeviceCounts>(1);
    args_.reached = masks_.room<unsigned long long>(b.tiles.size());
    args_.stream = work_;
    cuda_check(cudaMemsetAsync(args_.counts, 0, sizeof(DeviceCounts), work_), "counts");
    cuda_check(cudaMemsetAsync(args_.reached, 0, b.tiles.size() * sizeof(unsigned long long), work_), "masks");
  }

  /// Launches what the upload prepared, and waits for the counts.
  void run(const DeviceBatch& b, DeviceCounts& counts, unsigned long long* reached) {
    device::LaunchArgs l = args_;
    started_.record(work_);
    for (const DeviceRun& r : b.runs) {
      l.parts = args_.parts + r.first_part;
      l.part_count = r.parts;
      if (r.parts == 0) continue;
      table_.of(b.rule, r.model, b.age >= 0)(l);
      cuda_check(cudaGetLastError(), "launch");
    }
    fused_.record(work_);
    cuda_check(cudaMemcpyAsync(&counts, args_.counts, sizeof counts, cudaMemcpyDeviceToHost, work_), "counts");
    cuda_check(cudaMemcpyAsync(reached, args_.reached, b.tiles.size() * sizeof *reached, cudaMemcpyDeviceToHost, work_),
               "masks");
    cuda_check(cudaStreamSynchronize(work_), "fusion");
    times_.upload_s = started_.since(sent_);
    times_.fuse_s = fused_.since(started_);
  }

  /// Where tiles lie, to be read by kernels of the way back.
  const float* const* list_of(std::span<const float* const> tiles) {
    auto** const list = list_host_.room<const float*>(tiles.size());
    auto** const there = list_device_.room<const float*>(tiles.size());
    std::copy(tiles.begin(), tiles.end(), list);
    cuda_check(cudaMemcpyAsync(there, list, tiles.size_bytes(), cudaMemcpyHostToDevice, back_stream_), "list");
    return there;
  }

  std::string name_;
  device::DeviceTable table_;
  Stream work_, back_stream_;
  CudaEvent sent_, started_, fused_, fetching_, back_;
  Parcel parcel_;
  device::LaunchArgs args_{};
  CudaBuffer<false> counts_, masks_, arrays_, back_device_, list_device_, costs_device_;
  CudaBuffer<true> counts_host_, reached_host_, back_host_, list_host_, costs_host_;
  std::vector<std::uint64_t> reached_;
  std::vector<std::unique_ptr<CudaEvent>> piece_done_;
  std::size_t coming_ = 0, pieces_ = 0;
  std::vector<void*> slabs_;
  std::byte* next_ = nullptr;
  std::size_t left_ = 0;
  DeviceTimes times_;
};

}  // namespace

std::string why_no_cuda() {
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code != cudaSuccess) {
    cudaGetLastError();
    return std::string("CUDA finds no device: ") + cudaGetErrorString(code);
  }
  return count > 0 ? "" : "CUDA finds no device";
}
std::unique_ptr<Device> make_cuda_device() {
  if (const std::string why = why_no_cuda(); !why.empty()) throw DeviceError(why);
  return std::make_unique<Cuda>();
}

}  // namespace evigrid::kernels
