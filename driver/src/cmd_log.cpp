// SPDX-License-Identifier: Apache-2.0
// evigrid log FILE...: what a recorded log holds, before anything is made of it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <iostream>

#include "bag/frame_options.hpp"
#include "commands.hpp"
#include "log/readers.hpp"
#include "log/summary.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::vector<std::string> logs;
  std::string format = "auto", json;
  BagOptions bag;
};

void show_log(const Args& args) {
  using Json = nlohmann::ordered_json;
  const bool to_stdout = args.json == "-";
  if (!args.json.empty() && !to_stdout) require_writable(args.json);
  Json summary = summarise(read_log(args.logs, args.format, args.bag));
  summary["input"] = args.logs;
  const std::string bytes = summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!args.json.empty() && !to_stdout) write_file(args.json, bytes);
  std::cout << (to_stdout ? bytes : summary_text(summary));
}

}  // namespace

void add_log(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("log", "what a recorded log holds: sensors, scans, times, ranges, damage");
  command->add_option("FILE", args->logs, "a log: its file, files or folder, plain or .gz")->required();
  command->add_option("--format", args->format, fmt::format("{}", fmt::join(log_formats(), ", ")))
      ->capture_default_str();
  add_bag_options(*command, args->bag);
  command->add_option("--json", args->json, "also write the summary to this file; - for standard output instead");
  command->footer(
      "Formats (found by content; --format names one):\n" + describe_formats() +
      "\nShares are of the ranges as logged; \"in range\" is what a map would use with the limits shown.\n\n"
      "Examples:\n"
      "  evigrid log intel.log.gz\n"
      "  evigrid log lego_folder --json -\n");
  command->callback([args] { show_log(*args); });
}

}  // namespace evigrid::driver
