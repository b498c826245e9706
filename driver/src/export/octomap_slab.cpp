// SPDX-License-Identifier: Apache-2.0
// Keys of an octree count voxels of one size from its middle, as our indices do: cell i is key i + 32768.
#include "export/octomap_slab.hpp"

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <array>
#include <cmath>

#include "error.hpp"
#include "export/sweep.hpp"
#include "progress.hpp"

namespace evigrid::driver {
namespace {

constexpr std::int64_t kHalf = 32768;  // voxels from the middle to a side
constexpr double kNodeBytes = 64;      // of one voxel with its share of inner nodes

octomap::key_type key(std::int64_t cell, double cell_m) {
  if (cell < -kHalf || cell >= kHalf) {
    throw InputError(
        fmt::format("octomap: the map reaches {:.1f} m, an octree of {} m voxels ends at {:.1f} m; "
                    "--region exports a part",
                    static_cast<double>(cell) * cell_m, cell_m, kHalf * cell_m));
  }
  return static_cast<octomap::key_type>(cell + kHalf);
}

}  // namespace

bool octomap_is_built() noexcept { return true; }

void write_octomap(const Exported& what, const ExportOptions& o, std::ostream& out) {
  const double c = what.map.params().cell_m;
  const auto level = [&](double z_m) { return static_cast<std::int64_t>(std::floor(z_m / c + 1e-9)); };
  if (!(std::abs(o.z_low_m) < kHalf * c && std::abs(o.z_high_m) < kHalf * c))
    throw InputError(fmt::format("--slab: heights are beyond the {:.1f} m of an octree", kHalf * c));
  const std::int64_t low = level(o.z_low_m),
                     high = std::max(low + 1, static_cast<std::int64_t>(std::ceil(o.z_high_m / c - 1e-9)));
  octomap::OcTree tree(c);
  const float occupied = tree.getClampingThresMaxLog(), free = tree.getClampingThresMinLog();
  double voxels = 0;
  Progress progress("exporting");
  constexpr std::array kLayers{Layer::betp};
  sweep(
      what.map, kLayers,
      [&](CellIndex at, std::span<const float> values) {
        const double betp = static_cast<double>(values[0]);
        const bool is_occupied = betp > o.occupied;
        if (!is_occupied && !(betp < o.free)) return;
        voxels += static_cast<double>(high - low);
        require_fits("the octree (--region exports a part)", fmt::format("{} voxels", voxels), voxels * kNodeBytes,
                     o.max_image_mb);
        const octomap::key_type x = key(at.x, c), y = key(at.y, c);
        for (std::int64_t z = low; z < high; ++z)
          tree.setNodeValue(octomap::OcTreeKey(x, y, key(z, c)), is_occupied ? occupied : free, true);
      },
      [&](std::size_t tiles, std::size_t of) { progress.show(tiles, of); });
  if (tree.size() == 0) throw InputError(what.source + ": no cell is decided either way, the octree would be empty");
  tree.updateInnerOccupancy();
  tree.toMaxLikelihood();
  tree.prune();
  // As AbstractOccupancyOcTree::writeBinary, which also says "done." to the user.
  out << "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
      << "id " << tree.getTreeType() << "\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
  tree.writeBinaryData(out);
}

}  // namespace evigrid::driver
