// SPDX-License-Identifier: Apache-2.0
#include "export/export_options.hpp"
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>

#include "given_options.hpp"
#include "region_option.hpp"

namespace evigrid::driver {
namespace {

/// Options that say something of some formats alone.
struct Use {
  const char* option;
  std::vector<ExportFormat> formats;
};

std::vector<Use> uses() {
  using enum ExportFormat;
  return {{"--planes", {csv, npy}},
          {"--metres", {csv}},
          {"--mode", {map_server}},
          {"--occupied", {map_server, octomap, bag}},
          {"--free", {map_server, octomap, bag}},
          {"--max-unknown", {bag}},
          {"--slab", {octomap}},
          {"--frame", {npy, bag}},
          {"--topic", {bag}},
          {"--max-image-mb", {npy, map_server, octomap, bag}}};
}

void refuse_idle(const CLI::App& command, ExportFormat format) {
  for (const Use& use : uses()) {
    if (std::find(use.formats.begin(), use.formats.end(), format) != use.formats.end()) continue;
    std::string names;
    for (const ExportFormat one : use.formats)
      names.append(names.empty() ? "" : one == use.formats.back() ? " and " : ", ").append(name(one));
    refuse_given(command, {use.option}, "is for " + names);
  }
}

}  // namespace

ExportFormat ExportArgs::checked(const CLI::App& command) {
  const ExportFormat chosen = format.empty() ? export_format_of(out) : parse_export_format(format);
  require_built(chosen);
  refuse_idle(command, chosen);
  if (slab_m.size() == 2) options.z_low_m = slab_m[0], options.z_high_m = slab_m[1];
  check_export(options);
  return chosen;
}

void add_export_options(CLI::App& command, ExportArgs& args) {
  ExportOptions& o = args.options;
  command.add_option("-o,--out", args.out, "file to write, npy: folder; csv: - for standard output")->required();
  command.add_option("--format", args.format, "csv, npy, map_server, octomap or bag (default: by the extension of -o)");
  add_region_option(command, args.region_m);
  command.add_option("--planes", o.planes, "csv, npy: comma-separated, of " + plane_choices())
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_flag("--metres", o.metres, "csv: x_m,y_m of the cells' centres instead of their indices ix,iy");
  command.add_option("--mode", o.mode, "map_server: trinary, scale or raw")->capture_default_str();
  command.add_option("--occupied", o.occupied, "BetP above it is occupied (map_server, octomap, bag)")
      ->capture_default_str();
  command.add_option("--free", o.free, "BetP below it is free")->capture_default_str();
  command.add_option("--max-unknown", o.max_unknown, "bag: a cell with more m(unknown) holds no information")
      ->capture_default_str();
  command.add_option("--slab", args.slab_m, "octomap: z0,z1 in metres (default: one layer of voxels above z = 0)")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
  command.add_option("--frame", o.frame, "bag, npy: name of the map's frame")->capture_default_str();
  command.add_option("--topic", o.topic, "bag: topic of the grid")->capture_default_str();
  command.add_option("--max-image-mb", o.max_image_mb, "refuse dense output larger than this")->capture_default_str();
}

}  // namespace evigrid::driver
