// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "bag/bag.hpp"
#include "error.hpp"
#include "ros_bag/bag.hpp"

namespace evigrid::driver {

bool bags_are_built() noexcept { return true; }

void write_grid_bag(const Exported& what, const ExportOptions& o, const std::filesystem::path& file) {
  const CellRect& r = what.rect;
  const double c = what.map.params().cell_m;
  require_fits("the bag (--region exports a part)", fmt::format("{} x {} cells", r.width, r.height),
               static_cast<double>(r.width) * static_cast<double>(r.height), o.max_image_mb);
  ros_bag::Grid grid;
  grid.topic = o.topic;
  grid.frame = o.frame;
  grid.stamp_ns = what.stamp_ns;
  grid.resolution_m = c;
  grid.x_m = static_cast<double>(r.x) * c;
  grid.y_m = static_cast<double>(r.y) * c;
  grid.width = static_cast<std::uint32_t>(r.width);
  grid.height = static_cast<std::uint32_t>(r.height);
  grid.data.resize(static_cast<std::size_t>(r.width * r.height));
  what.map.render(Costmap{o.free, o.occupied, o.max_unknown}, r, std::span<std::int8_t>(grid.data), r.width);
  try {
    ros_bag::write_grid(file.string(), grid);
  } catch (const ros_bag::Error& bad) {
    throw InputError(fmt::format("the bag cannot be written: {}", bad.what()));
  }
}

}  // namespace evigrid::driver
