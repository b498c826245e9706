// SPDX-License-Identifier: Apache-2.0
// All that the engine knows of a device: memory for tiles, and batches of readings fused into them. Plain C++; the CUDA
// device (cuda_device.cu) and its emulation (emulated_device.cpp) are made behind it. One caller at a time.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {

/// Out of memory, or the device failed; the message says what. Cells are what they were, on the host and on the device.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The device failed while it wrote to cells: those of the batch's tiles are undefined there.
struct DeviceLost : DeviceError {
  using DeviceError::DeviceError;
};

/// A tile of the batch, and where its cells are on the device.
struct DeviceTile {
  std::int64_t x = 0, y = 0;    // tile coordinates
  float* cells = nullptr;       // of the device, from Device::take
  const float* host = nullptr;  // what to fill it with first; nullptr: the device's cells are those of the map
};

/// Consecutive readings of one kind: all cones of one model, or all fans. They are fused one run after the other.
struct DeviceRun {
  int model = 0;  // a ConeModel; −1: fans
  std::uint32_t first_part = 0, parts = 0;
};
/// What a run has for one tile: readings in their order.
struct DevicePart {
  std::uint32_t tile = 0, first = 0, count = 0;  // reaches[first …]
};

/// Of maps that forget: when a reading was made, and how fast it is forgotten.
struct ReadingAge {
  std::int64_t stamp_ns = 0;
  float tau_s = 0;
};

struct DeviceBatch {
  int rule = 0;  // a RuleKernel
  int planes = 3;
  int age = -1;  // the first of three planes of age, of maps that forget
  bool conflict_plane = false;
  RuleArgs args{};
  std::span<const DeviceTile> tiles;
  std::span<const ConeReading* const> cones;        // reaches of a run of cones count in these,
  std::span<const Fan* const> fans;                 // those of fans in these
  std::span<const ReadingAge> cone_ages, fan_ages;  // of maps that forget: one each
  std::span<const DeviceRun> runs;
  std::span<const DevicePart> parts;
  std::span<const std::uint32_t> reaches;
};

/// Valid until the next call of the device.
struct DeviceResult {
  Stats stats;
  std::span<const std::uint64_t> reached;  // a tile: bit 8·y + x of its 8 × 8 blocks in which a cell was updated
};

/// Seconds by the device's own clock, where it has one: of the last batch, its kernels alone in fuse_s; of what was
/// last fetched.
struct DeviceTimes {
  double upload_s = 0, fuse_s = 0, download_s = 0;
};

class Device {
 public:
  virtual ~Device() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// Room for a tile, not set. Throws DeviceError.
  virtual float* take(std::size_t bytes) = 0;
  /// Gives all room back.
  virtual void release() noexcept = 0;
  /// Fuses a batch; the cells stay on the device. Throws DeviceError, DeviceLost.
  virtual DeviceResult fuse(const DeviceBatch&) = 0;
  /// Sends cells of the device home: tiles of so many floats, one after the other. They are still on their way when it
  /// returns. Throws DeviceError.
  virtual const float* fetch(std::span<const float* const> tiles, std::size_t floats) = 0;
  /// Waits until the first `tiles` of them have arrived. Throws DeviceError.
  virtual void arrived(std::size_t tiles) = 0;
  /// Costs of the cells of these tiles, whose first planes are e, o and u without c: kTileSide rows of kTileSide bytes
  /// a tile, as KernelTable::render_costs makes them. Throws DeviceError.
  virtual const std::uint8_t* costs(const CostArgs&, std::span<const float* const> tiles, int planes) = 0;
  /// C = A ⊕ B by a rule of the batch call, arrays of the host; the number of total conflicts.
  virtual std::uint64_t combine(int rule, const DensePlanes&, std::size_t n) = 0;
  /// Bytes read and written a second by the device's own copy of `bytes`; 0 where it cannot tell.
  virtual double copy_rate(std::size_t) { return 0; }
  [[nodiscard]] virtual DeviceTimes times() const { return {}; }
};

/// The CUDA device of this process's first GPU; throws DeviceError. Null where it was not compiled in.
std::unique_ptr<Device> make_cuda_device();
/// Empty when make_cuda_device() can be asked; else why not.
std::string why_no_cuda();
/// The same text by this processor, one thread: for tests.
std::unique_ptr<Device> make_emulated_device();

}  // namespace evigrid::kernels
