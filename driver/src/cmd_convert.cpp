// SPDX-License-Identifier: Apache-2.0
// evigrid convert IN -o OUT: other programs' maps to ours, ours to theirs, by their extensions.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "error.hpp"
#include "evigrid/io.hpp"
#include "export/export_options.hpp"
#include "given_options.hpp"
#include "options.hpp"
#include "prior_map.hpp"
#include "region_option.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;

struct Args {
  std::string in, rule = "pcr5";
  double certainty = 0.9;
  std::optional<double> resolution_m;
  ExportArgs to;
};

bool is_plan(const std::string& in) {
  const std::string extension = fs::path(in).extension().string();
  constexpr std::string_view kPlans[] = {".yaml", ".yml", ".pgm", ".png", ".bmp", ".map"};
  return std::find(std::begin(kPlans), std::end(kPlans), extension) != std::end(kPlans);
}

Map read_plan(const Args& args) {
  if (!args.to.region_m.empty()) throw InputError("--region: is for saved maps; a plan is read whole");
  try {
    const scenes::FloorPlan plan = scenes::load_plan(args.in, {.resolution_m = args.resolution_m});
    PriorMap prior = map_of(plan, {parse_map_rule(args.rule), args.certainty});
    if (!prior.aligned)
      std::cerr << fmt::format(
          "evigrid: {}: its origin is turned, or not a whole number of cells away from 0: each cell of the map took "
          "the pixel under its centre\n",
          args.in);
    return std::move(prior.map);
  } catch (const scenes::SceneError& bad) {
    throw InputError(bad.what());
  }
}

void write(const Map& map, const CellRect& rect, std::int64_t stamp_ns, const Args& args,
           std::optional<ExportFormat> format) {
  if (map.bounds().empty()) throw InputError(args.in + ": says nothing of any cell, there is nothing to write");
  const std::string& to = args.to.out;
  if (format) {
    return export_map({map, rect, stamp_ns, args.in, fmt::format("{:016x}", map.hash())}, *format, args.to.options, to);
  }
  // save() by path would replace links, devices and pipes.
  write_file_by(to, [&](std::ostream& file) { save(map, file); });
  std::cout << fmt::format("{}: {} tiles, {}, cell {:g} m, map hash {:016x}\n", to, map.tiles(),
                           name(map.params().rule), map.params().cell_m, map.hash());
}

void convert(Args args, const CLI::App& command) {
  const bool ours =
      args.to.format == "evigrid" || (args.to.format.empty() && fs::path(args.to.out).extension() == ".evigrid");
  if (ours) {
    refuse_given(command,
                 {"--planes", "--metres", "--mode", "--occupied", "--free", "--max-unknown", "--slab", "--frame",
                  "--topic", "--max-image-mb"},
                 "says nothing of a saved map, which holds every cell as it is");
  }
  if (!is_plan(args.in)) {
    refuse_given(command, {"--certainty", "--rule", "--resolution"},
                 "is for plans; the cells of a saved map are what they are");
  }
  std::optional<ExportFormat> format;
  if (!ours) format = args.to.checked(command);
  if (ours) require_writable(args.to.out);
  if (is_plan(args.in)) {
    const Map map = read_plan(args);
    return write(map, map.bounds(), 0, args, format);
  }
  const SavedMap saved = open_saved_map(args.in, nullptr, args.to.region_m);
  const CellRect rect =
      args.to.region_m.empty() ? saved.map.bounds() : cells_of(args.to.region_m, saved.map.params().cell_m);
  write(saved.map, rect, saved.info.last_stamp_ns.value_or(0), args, format);
}

}  // namespace

void add_convert(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("convert", "other programs' maps to a saved map, and a saved map to theirs");
  command
      ->add_option("IN", args->in,
                   "ROS map_server yaml, an image with --resolution, a MovingAI .map; or a saved map or its folder")
      ->required();
  command
      ->add_option("--certainty", args->certainty,
                   "in (0, 1]: an occupancy of P becomes m(occupied) = P times this, m(empty) = (1 - P) times this")
      ->capture_default_str();
  command->add_option("--rule", args->rule, "combination rule of the new map: " + map_rule_names())
      ->capture_default_str();
  command->add_option("--resolution", args->resolution_m,
                      "m: side of a pixel of a bare image; its corner is at (0, 0)");
  add_export_options(*command, args->to);
  command->footer(
      "OUT by its extension: .evigrid a saved map; .csv, .yaml, .bt, .bag as `evigrid export`. Unknown pixels stay "
      "unseen;\nin the modes scale and raw greys keep their probability. docs/formats.md\n\n"
      "Examples:\n"
      "  evigrid convert house.yaml -o house.evigrid --certainty 0.8\n"
      "  evigrid convert plan.png --resolution 0.05 -o plan.evigrid --rule dempster\n"
      "  evigrid convert out -o corner.evigrid --region 0,0,5,5\n"
      "  evigrid convert house.evigrid -o copy.yaml --mode raw\n");
  command->callback([args, command] { convert(*args, *command); });
}

}  // namespace evigrid::driver
