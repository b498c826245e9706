// SPDX-License-Identifier: Apache-2.0
// A map's tiles on a device. They stay there from batch to batch; the host's tiles are brought up to date after each,
// so that whoever reads the map never waits for a device. A tile that anyone else changed since is sent again.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "integrate.hpp"
#include "kernels/device/device.hpp"
#include "scratch.hpp"

namespace evigrid {

class DeviceMap {
 public:
  explicit DeviceMap(std::unique_ptr<kernels::Device> device) : device_(std::move(device)) {}
  [[nodiscard]] kernels::Device& device() noexcept { return *device_; }

  /// The store was cleared.
  void forget() noexcept {
    device_->release();
    taken_ = 0;
  }

  /// The readings of the plan, as the regions' tasks would fuse and mark them. Throws kernels::DeviceError before
  /// anything has changed, std::runtime_error when the device was lost while tiles came back.
  kernels::Stats fuse(const Pipeline&, Scratch&, const kernels::RuleArgs&);

 private:
  void list_runs(const MapParams&, const Scratch&);
  void list_parts(const Plan&);
  void list_tiles(const Pipeline&, const Plan&);
  void take_back(const Pipeline&, Plan&, const kernels::DeviceResult&);

  std::unique_ptr<kernels::Device> device_;
  std::size_t taken_ = 0;  // tiles of the device
  // Of a batch; kept for their memory.
  struct Entry {
    std::uint32_t run, tile, reading;
  };
  std::vector<std::uint32_t> run_of_, place_of_;  // by footprint: its run, its place among the cones or the fans
  std::vector<const kernels::ConeReading*> cones_;
  std::vector<const kernels::Fan*> fans_;
  std::vector<kernels::ReadingAge> cone_ages_, fan_ages_;
  std::vector<Entry> entries_, sorted_;
  std::vector<kernels::DeviceRun> runs_;
  std::vector<kernels::DevicePart> parts_;
  std::vector<std::uint32_t> reaches_;
  std::vector<kernels::DeviceTile> tiles_;
  std::vector<std::size_t> updated_;
};

}  // namespace evigrid
