// SPDX-License-Identifier: Apache-2.0
// evigrid paper NAME|all -o DIR: the behaviours of a paper, its published figures beside ours, as a page and as JSON.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>

#include "commands.hpp"
#include "error.hpp"
#include "evigrid/version.hpp"
#include "mapping.hpp"
#include "out/out_dir.hpp"
#include "paper/index.hpp"
#include "paper/paper.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string name, out_dir;
  std::int64_t seed = 0;
  PaperOptions options;
};

std::string paper_names() {
  std::string out;
  for (const Paper& p : papers()) out.append(out.empty() ? "" : ", ").append(p.name);
  return out;
}

PaperRun run_one(const Paper& paper, const PaperOptions& options, const std::string& dir) {
  OutDir out(dir);
  const auto start = Clock::now();
  PaperResult result = paper.run(options);
  nlohmann::ordered_json report{{"paper", paper.name},
                                {"title", paper.title},
                                {"version", EVIGRID_VERSION},
                                {"quick", options.quick},
                                {"findings", to_json(result.findings)}};
  if (!options.world.empty()) report["world"] = options.world;
  if (!result.details.is_null()) report["details"] = result.details;
  const double wall_s = seconds_since(start);
  report["wall_s"] = wall_s;
  for (const PaperFile& file : result.files) out.write(file.name, file.bytes, {});
  out.write("report.html", result.page.html());
  out.write("report.json", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  out.commit();
  const Tally t = tally(result.findings);
  fmt::print("{}: {} of {} published outcomes met, {} of {} floors held, {} figures reported; {}/report.html\n",
             paper.name, t.met, t.met + t.missed, t.floors - t.below, t.floors, t.others, dir);
  for (const Finding& f : result.findings) {
    if (asks(f.aim) && !f.met) fmt::print("  not met: {}: {}, ours {}\n", f.name, f.published, f.ours);
  }
  std::cout.flush();
  return {&paper, std::move(result.findings), wall_s};
}

void run_all(const Args& args) {
  OutDir out(args.out_dir);
  std::vector<PaperRun> runs;
  for (const Paper& p : papers()) runs.push_back(run_one(p, args.options, args.out_dir + "/" + std::string(p.name)));
  out.write("index.html", index_page(runs));
  out.write("index.json", index_json(runs).dump(2) + "\n");
  out.commit();
  fmt::print("{}/index.html\n", args.out_dir);
}

void run_papers(Args args) {
  if (args.seed < 0) throw InputError(fmt::format("--seed: {} is below 0", args.seed));
  args.options.seed = static_cast<std::uint64_t>(args.seed);
  for (const auto& [given, name] :
       {std::pair{!args.options.start.empty(), "--start"}, {args.options.resolution_m.has_value(), "--resolution"}}) {
    if (given && args.options.world.empty()) throw InputError(fmt::format("{}: is for --world", name));
  }
  if (args.name == "all") return run_all(args);
  for (const Paper& p : papers()) {
    if (args.name != p.name) continue;
    run_one(p, args.options, args.out_dir);
    return;
  }
  throw InputError(fmt::format("paper '{}' is unknown; known: {}, all", args.name, paper_names()));
}

}  // namespace

void add_paper(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("paper", "run the behaviours of a paper and compare with its figures");
  command->add_option("name", args->name, paper_names() + ", or all")->required();
  command->add_option("-o,--out", args->out_dir, "folder for report.html, report.json and pictures")->required();
  command->add_option("--seed", args->seed, "of all noise; 0: the paper's scene's own")->capture_default_str();
  command->add_option("--threads", args->options.threads, "worker threads; 0: as many as the machine has")
      ->capture_default_str();
  command->add_flag("--quick", args->options.quick, "fewer runs and steps of the same code");
  command->add_option("--world", args->options.world,
                      "a floor plan (ROS yaml, png, pgm, bmp, .map) or a mesh instead of the paper's room");
  command->add_option("--start", args->options.start,
                      "x,y or x,y,yaw_deg in the --world (default: in its widest place)");
  command->add_option("--resolution", args->options.resolution_m,
                      "m per pixel of a --world image, m per unit of a mesh");
  command->footer(
      "Writes DIR/report.html, one page that needs nothing else, report.json with each published figure beside ours,\n"
      "and the pictures. `all` makes a folder of each paper in DIR, and DIR/index.html over them. The same seed gives "
      "the same\nfigures, but for times.\n\n"
      "Examples:\n"
      "  evigrid paper hughes1992 -o out/hughes\n"
      "  evigrid paper all -o out/papers --quick\n"
      "  evigrid paper hughes1992 -o out/office --world office.yaml\n"
      "  evigrid paper li2014 -o out/robot --world office.yaml --start 2,3,90\n"
      "  evigrid paper delafosse2007 -o out/loop --world office.yaml\n"
      "  evigrid paper all -o out/all --world office.png --resolution 0.05\n");
  command->callback([args] { run_papers(*args); });
}

}  // namespace evigrid::driver
