// SPDX-License-Identifier: Apache-2.0
// A map's tiles on a device. They stay there from batch to batch. What a batch changes is known to the device alone
// until someone on the host reads it: such a tile is away, and comes home when it is asked for. Costs of tiles that are
// away are made there, a sixteenth of the bytes. A tile that anyone else changed since is sent again.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "grid/admission.hpp"
#include "grid/tile_costs.hpp"
#include "integrate.hpp"
#include "kernels/device/device.hpp"
#include "scratch.hpp"

namespace evigrid {

class DeviceMap {
 public:
  explicit DeviceMap(std::unique_ptr<kernels::Device> device) : device_(std::move(device)) {}
  [[nodiscard]] kernels::Device& device() noexcept { return *device_; }

  /// The store was cleared.
  void forget() noexcept;

  /// The readings of the plan, as the regions' tasks would fuse and mark them. Throws kernels::DeviceError when nothing
  /// has changed on the host, where the batch can be fused once all tiles have come home; std::runtime_error as
  /// come_home() when the device was lost with tiles that were away, for good.
  kernels::Stats fuse(const Pipeline&, Scratch&, const kernels::RuleArgs&);

  /// Whether there may be tiles that are away.
  [[nodiscard]] bool any_away() const noexcept { return any_away_.load(std::memory_order_acquire); }
  /// For readers, any number at once: the tiles of `part` come home, or all. By the calling thread alone, which may be
  /// a task of the map's executor. Throws std::runtime_error when the device was lost: the map is not whole then.
  void come_home(TileStore&, const TileRect* part);
  /// For who is about to change cells on the host: all tiles, by all threads. Throws as above.
  void come_home(TileStore&, Executor&);
  /// For readers, any number at once: the costs of all that is away. Null where only the host can tell; then the tiles
  /// must come home.
  std::shared_ptr<const TileCosts> costs(TileStore&, const kernels::CostArgs&);

 private:
  struct RenderedCosts {
    kernels::CostArgs args;
    std::shared_ptr<TileCosts> tiles;
    std::uint64_t batch = 0;  // after so many batches they were complete
  };
  [[noreturn]] void not_whole() const;
  void list_runs(const MapParams&, const Scratch&);
  void list_region(const Plan&, std::size_t region);
  void list_parts(const Plan&, Executor&);
  void list_tiles(const Pipeline&, const Plan&);
  void mark(const Pipeline&, Plan&, const kernels::DeviceResult&);
  [[nodiscard]] std::vector<Tile*> away_in(TileStore&, const TileRect*) const;
  void tidy(TileStore&);
  void copy_home(TileStore&, const TileRect*, Executor*);
  void copy_home(const std::vector<Tile*>&, std::size_t bytes, Executor*);
  void render(TileStore&, RenderedCosts&);

  std::unique_ptr<kernels::Device> device_;
  std::size_t taken_ = 0;  // tiles of the device
  std::uint64_t batches_ = 0;
  std::string lost_;  // why no tile that is away will ever come home
  // Between readers.
  std::mutex mutex_;
  std::atomic<bool> any_away_ = false;
  std::vector<TileIndex> away_;  // at least once each, and some that were dropped or came home since
  std::vector<RenderedCosts> rendered_;
  // Of a batch; kept for their memory.
  struct RegionParts {
    struct Part {
      std::uint32_t run;
      kernels::DevicePart part;
    };
    std::vector<Part> parts;
    std::vector<std::uint32_t> end_of_tile;
  };
  std::vector<std::uint32_t> run_of_, place_of_;  // by footprint: its run, its place among the cones or the fans
  std::vector<const kernels::ConeReading*> cones_;
  std::vector<const kernels::Fan*> fans_;
  std::vector<kernels::ReadingAge> cone_ages_, fan_ages_;
  std::vector<RegionParts> of_region_;
  std::vector<kernels::DeviceRun> runs_;
  std::vector<std::uint32_t> next_part_;
  std::vector<kernels::DevicePart> parts_;
  std::vector<std::uint32_t> reaches_;
  std::vector<kernels::DeviceTile> tiles_;
};

}  // namespace evigrid
