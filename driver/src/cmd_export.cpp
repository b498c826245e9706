// SPDX-License-Identifier: Apache-2.0
// evigrid export MAP -o OUT: a saved map in another program's format.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "commands.hpp"
#include "export/export_options.hpp"
#include "region_option.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string map;
  ExportArgs to;
};

void export_saved(Args args, const CLI::App& command) {
  const ExportFormat format = args.to.checked(command);
  const SavedMap saved = open_saved_map(args.map, nullptr, args.to.region_m);
  const CellRect rect =
      args.to.region_m.empty() ? saved.map.bounds() : cells_of(args.to.region_m, saved.map.params().cell_m);
  export_map(
      {saved.map, rect, saved.info.last_stamp_ns.value_or(0), saved.path, fmt::format("{:016x}", saved.info.hash)},
      format, args.to.options, args.to.out);
}

}  // namespace

void add_export(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("export", "a saved map as CSV, NumPy, ROS map_server, OctoMap or ROS bag");
  command->add_option("MAP", args->map, "map file (.evigrid), or the folder that map or run wrote")->required();
  add_export_options(*command, args->to);
  command->footer(
      "csv: a row a cell that was seen, ix,iy,e,o,u,...,betp: cell (ix, iy) covers [ix*cell, (ix+1)*cell) in x, the "
      "same\nin y. npy: PLANE.npy of each plane, float32, row 0 the smallest y, and grid.json (origin, cell size, "
      "hash).\nmap_server: FILE.yaml and FILE.pgm. octomap: FILE.bt, voxels of the cell's size (built with "
      "liboctomap-dev).\nbag: nav_msgs/OccupancyGrid in a ROS bag (built with librosbag-storage-dev). Files come whole "
      "or not at all.\ndocs/formats.md\n\n"
      "Examples:\n"
      "  evigrid export out -o cells.csv --metres --planes e,o,u,betp\n"
      "  evigrid export out -o arrays --format npy\n"
      "  evigrid export out -o house.yaml --mode scale --occupied 0.7 --free 0.3\n"
      "  evigrid export out -o house.bt --slab 0,1.2\n"
      "  evigrid export out -o house.bag --topic /map --region=-2,-2,6,4\n");
  command->callback([args, command] { export_saved(*args, *command); });
}

}  // namespace evigrid::driver
