// SPDX-License-Identifier: Apache-2.0
// evigrid show MAP: a saved map as a picture, or, without -o, in the terminal.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "error.hpp"
#include "out/out_dir.hpp"
#include "picture/map_picture.hpp"
#include "picture/terminal.hpp"
#include "region_option.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string map, out, layer = "mixed";
  std::vector<double> region_m;
  int scale = 0, max_image_mb = 2048, columns = 0;
  bool surface = false, ascii = false;
};

void show(const Args& args) {
  const Look look = args.surface ? Look::surface : parse_look("--layer", args.layer);
  if (args.scale < 0) throw InputError(fmt::format("--scale: {} is below 1", args.scale));
  if (args.columns < 0) throw InputError(fmt::format("--columns: {} is below 1", args.columns));
  if (args.max_image_mb <= 0) throw InputError(fmt::format("--max-image-mb: {} is not above 0", args.max_image_mb));
  if (!args.out.empty()) require_writable(args.out);
  const SavedMap saved = open_saved_map(args.map, nullptr, args.region_m);
  const CellRect rect = args.region_m.empty() ? saved.map.bounds() : cells_of(args.region_m, saved.map.params().cell_m);
  if (rect.empty()) throw InputError(saved.path + ": is a map without a single reading, there is nothing to show");
  const std::string named = args.out.empty() ? "the picture" : std::filesystem::path(args.out).filename().string();
  const Layers layers = render_layers(saved.map, rect, named + " (--region shows a part)", args.max_image_mb);
  if (!is_kept(look, layers))
    throw InputError(
        fmt::format("--layer: {} keeps no {}; map with --layers {}", saved.path, row_of(look).name, row_of(look).name));
  if (args.out.empty()) {
    const int columns = args.columns > 0 ? args.columns : terminal_columns();
    std::cout << terminal_picture(look, layers, columns, on_terminal() && !args.ascii);
    return;
  }
  const PictureText text{
      "evigrid: " + describe_map(saved),
      fmt::format("{}, map hash {:016x}, {} x {} cells", std::filesystem::path(saved.path).filename().string(),
                  saved.info.hash, rect.width, rect.height)};
  const std::vector<std::byte> bytes = png(draw(look, layers, {}, text, {args.scale, args.max_image_mb, named}));
  write_file(args.out, bytes);
}

}  // namespace

void add_show(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("show", "a saved map as a picture or in the terminal");
  command->add_option("MAP", args->map, "map file (.evigrid), or the folder that map or run wrote")->required();
  command->add_option("-o,--out", args->out, "PNG file; without one the map is drawn in the terminal");
  command->add_option("--layer", args->layer, look_names())->capture_default_str();
  add_region_option(*command, args->region_m);
  command->add_option("--scale", args->scale, "pixels a cell (default: small maps fill about 900 pixels)");
  command->add_flag("--surface", args->surface, "Bel(occupied) as a surface over x and y; as --layer surface");
  command->add_flag("--ascii", args->ascii, "letters in the terminal instead of coloured blocks");
  command->add_option("--columns", args->columns, "width in the terminal (default: the terminal's, or 80)");
  command->add_option("--max-image-mb", args->max_image_mb, "refuse a picture larger than this")->capture_default_str();
  command->footer(
      "Layers with numbers (betp to costmap) have a colour bar; grey cells were never seen. con and last_conflict: "
      "only\n"
      "of maps made with --layers con or last_conflict. mixed: the masses mixed, as map.png; composite and panels: one "
      "grey picture of the three "
      "masses,\n"
      "and each beside it, as Hughes & Murphy 1992 show theirs; surface: Bel(occupied) in 3-D, as Li et al. 2006.\n"
      "In a terminal that shows 24-bit colours the map is drawn in half blocks; into a pipe, or with --ascii, in "
      "letters.\n\n"
      "Examples:\n"
      "  evigrid show out\n"
      "  evigrid show out/map.evigrid --layer betp -o betp.png\n"
      "  evigrid show out --region=-2,-2,6,4 --scale 8 -o corner.png\n"
      "  evigrid show out --surface -o surface.png\n");
  command->callback([args] { show(*args); });
}

}  // namespace evigrid::driver
