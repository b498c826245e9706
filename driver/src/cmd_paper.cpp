// SPDX-License-Identifier: Apache-2.0
// evigrid paper NAME|all -o DIR: the behaviours of a paper, its published figures beside ours, as a page and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "commands.hpp"
#include "error.hpp"
#include "evigrid/version.hpp"
#include "mapping.hpp"
#include "out/out_dir.hpp"
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

void run_one(const Paper& paper, const PaperOptions& options, const std::string& dir) {
  OutDir out(dir);
  const auto start = Clock::now();
  const PaperResult result = paper.run(options);
  nlohmann::ordered_json report{{"paper", paper.name}, {"title", paper.title}, {"version", EVIGRID_VERSION},
                                {"quick", options.quick}, {"findings", to_json(result.findings)}};
  if (!result.details.is_null()) report["details"] = result.details;
  report["wall_s"] = seconds_since(start);
  for (const PaperFile& file : result.files) out.write(file.name, file.bytes, {});
  out.write("report.html", result.page.html());
  out.write("report.json", report.dump(2) + "\n");
  out.commit();
  const auto is = [](bool met) {
    return [met](const Finding& f) { return f.aim == Aim::target && f.met == met; };
  };
  const auto met = std::count_if(result.findings.begin(), result.findings.end(), is(true));
  const auto missed = std::count_if(result.findings.begin(), result.findings.end(), is(false));
  fmt::print("{}: {} of {} published outcomes met, {} figures reported; {}/report.html\n", paper.name, met,
             met + missed, static_cast<std::int64_t>(result.findings.size()) - met - missed, dir);
  for (const Finding& f : result.findings) {
    if (is(false)(f)) fmt::print("  not met: {}: published {}, ours {}\n", f.name, f.published, f.ours);
  }
}

void run_papers(Args args) {
  if (args.seed < 0) throw InputError(fmt::format("--seed: {} is below 0", args.seed));
  args.options.seed = static_cast<std::uint64_t>(args.seed);
  std::vector<const Paper*> wanted;
  for (const Paper& p : papers()) {
    if (args.name == "all" || args.name == p.name) wanted.push_back(&p);
  }
  if (wanted.empty()) {
    throw InputError(fmt::format("paper '{}' is unknown; known: {}, all", args.name, paper_names()));
  }
  for (const Paper* p : wanted) {
    if (!args.options.world.empty() && !p->takes_world) {
      throw InputError(fmt::format("--world: {} is a comparison in its own room and takes no other", p->name));
    }
  }
  for (const Paper* p : wanted) {
    run_one(*p, args.options, args.name == "all" ? args.out_dir + "/" + std::string(p->name) : args.out_dir);
    std::cout.flush();
  }
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
                      "a floor plan (ROS yaml, png, pgm, bmp, .map) instead of the paper's room");
  command->footer(
      "Writes DIR/report.html, one page that needs nothing else, report.json with each published figure beside ours,\n"
      "and the pictures. `all` makes a folder of each paper in DIR. The same seed gives the same figures, but for "
      "times.\n\n"
      "Examples:\n"
      "  evigrid paper hughes1992 -o out/hughes\n"
      "  evigrid paper all -o out/papers --quick\n"
      "  evigrid paper hughes1992 -o out/office --world office.yaml\n");
  command->callback([args] { run_papers(*args); });
}

}  // namespace evigrid::driver
