// SPDX-License-Identifier: Apache-2.0
// evigrid diff A B: two saved maps of one place side by side, and how far they agree.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "diff/map_difference.hpp"
#include "error.hpp"
#include "out/out_dir.hpp"
#include "picture/map_picture.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

constexpr int kPanel_px = 640;

struct Args {
  std::string a, b, out, json;
  int max_image_mb = 2048;
};

void require_one_lattice(const SavedMap& a, const SavedMap& b) {
  const double cell_a = a.map.params().cell_m, cell_b = b.map.params().cell_m;
  if (cell_a != cell_b)
    throw InputError(fmt::format("{} has cells of {:g} m, {} of {:g} m: their cells do not lie on each other", a.path,
                                 cell_a, b.path, cell_b));
}

nlohmann::ordered_json facts(const SavedMap& saved) {
  return {{"file", saved.path},
          {"rule", name(saved.map.params().rule)},
          {"map_hash", fmt::format("{:016x}", saved.info.hash)}};
}

std::string percent(double share) { return std::isnan(share) ? "none" : fmt::format("{:.2f} %", 100 * share); }

std::string line_of(const char* what, const Deviation& d, double cell_m) {
  const auto middle = [&](std::int64_t i) { return (static_cast<double>(i) + 0.5) * cell_m; };
  std::string out =
      fmt::format("{:<12}{:>12.3g}{:>12.3g}{:>12.3g}{:>12.3g}", what, d.mean, d.mean_abs, d.rms, d.largest);
  if (d.largest > 0) out += fmt::format("  at x {:.2f} m, y {:.2f} m", middle(d.at.x), middle(d.at.y));
  return out + "\n";
}

std::string text_of(const SavedMap& a, const SavedMap& b, const MapDifference& d) {
  std::string out = fmt::format("A  {}  {}, map hash {:016x}\nB  {}  {}, map hash {:016x}\n", a.path, describe_map(a),
                                a.info.hash, b.path, describe_map(b), b.info.hash);
  if (a.map.params().rule != b.map.params().rule) out += "the rules differ: so may the masses, without a mistake\n";
  if (d.same()) return out + fmt::format("the same: all {} cells seen hold the same bits\n", d.seen_a);
  out += fmt::format("cells seen: {} by A, {} by B, {} by both, {} of these with the same bits\n", d.seen_a, d.seen_b,
                     d.seen_both, d.same_bits);
  out += fmt::format("{:<12}{:>12}{:>12}{:>12}{:>12}\n", "B - A", "mean", "mean |.|", "rms", "largest");
  const double cell_m = a.map.params().cell_m;
  out += line_of("m(empty)", d.empty, cell_m) + line_of("m(occupied)", d.occupied, cell_m) +
         line_of("m(unknown)", d.unknown, cell_m) + line_of("BetP", d.betp, cell_m);
  out += fmt::format("{:<12}{:>14}{:>14}{:>14}\n", "decisions", "B unknown", "B empty", "B occupied");
  constexpr const char* kRows[] = {"A unknown", "A empty", "A occupied"};
  for (std::size_t i = 0; i < 3; ++i)
    out += fmt::format("{:<12}{:>14}{:>14}{:>14}\n", kRows[i], d.decisions[i][0], d.decisions[i][1], d.decisions[i][2]);
  return out + fmt::format("of the cells that both decide: {} alike, {} against each other\n", percent(d.agreement),
                           percent(d.contradict));
}

Canvas picture(const SavedMap& a, const SavedMap& b, const Layers& la, const Layers& lb, const MapDifference& d) {
  const SheetScale scale = sheet_scale(d.rect, kPanel_px);
  const auto panel = [&](const char* title, const SavedMap& saved, const Layers& layers) {
    return Panel{title,
                 {saved.path, describe_map(saved), fmt::format("map hash {:016x}", saved.info.hash)},
                 thumbnail(layers, scale)};
  };
  const Panel between{
      "B - A",
      {"red: B surer of occupied; blue: A; grey: seen by neither",
       fmt::format("BetP differs by {:.3g} in the mean, {:.3g} at most", d.betp.mean_abs, d.betp.largest),
       fmt::format("{} decided alike", percent(d.agreement))},
      difference_thumbnail(la, lb, scale)};
  return draw_sheet("evigrid diff", {panel("A", a, la), panel("B", b, lb), between}, 3);
}

void diff(const Args& args) {
  if (args.max_image_mb <= 0) throw InputError(fmt::format("--max-image-mb: {} is not above 0", args.max_image_mb));
  if (!args.out.empty()) require_writable(args.out);
  if (!args.json.empty() && args.json != "-") require_writable(args.json);
  const SavedMap a = open_saved_map(args.a), b = open_saved_map(args.b);
  require_one_lattice(a, b);
  const CellRect rect = box_around(a.map.bounds(), b.map.bounds());
  const Layers la = render_layers(a.map, rect, "the comparison", args.max_image_mb);
  const Layers lb = render_layers(b.map, rect, "the comparison", args.max_image_mb);
  const MapDifference d = difference(la, lb);
  if (!args.out.empty()) {
    if (rect.empty()) throw InputError("both maps are without a single reading, there is nothing to show");
    write_file(args.out, std::span<const std::byte>(png(picture(a, b, la, lb, d))));
  }
  if (args.json.empty()) {
    std::cout << text_of(a, b, d);
    return;
  }
  nlohmann::ordered_json all{{"a", facts(a)}, {"b", facts(b)}};
  all.update(to_json(d));
  const std::string bytes = all.dump(2) + "\n";
  if (args.json == "-") {
    std::cout << bytes;
  } else {
    std::cout << text_of(a, b, d);
    write_file(args.json, bytes);
  }
}

}  // namespace

void add_diff(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("diff", "two saved maps side by side: agreement, differences, picture");
  command->add_option("A", args->a, "map file (.evigrid), or the folder that map or run wrote")->required();
  command->add_option("B", args->b, "the other; cells of the same size")->required();
  command->add_option("-o,--out", args->out, "PNG file: A, B, and where they differ");
  command->add_option("--json", args->json, "write the figures to this file as JSON; - for standard output");
  command->add_option("--max-image-mb", args->max_image_mb, "refuse maps whose dense planes are larger than this")
      ->capture_default_str();
  command->footer(
      "Cells are compared where at least one map has seen something; a cell never seen is vacuous. Decisions are those "
      "of\n"
      "Li et al. 2014: m(unknown) < 0.5 and the larger of m(empty), m(occupied). The exit code is 0 also when they "
      "differ:\n"
      "\"same\" of --json says whether every cell holds the same bits.\n\n"
      "Examples:\n"
      "  evigrid diff out/pcr5 out/dempster\n"
      "  evigrid diff before.evigrid after.evigrid -o diff.png --json diff.json\n");
  command->callback([args] { diff(*args); });
}

}  // namespace evigrid::driver
