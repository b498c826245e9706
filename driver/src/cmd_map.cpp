// SPDX-License-Identifier: Apache-2.0
// evigrid map LOG... -o DIR: a recorded log becomes a map.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "log/readers.hpp"
#include "mapping.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::vector<std::string> logs;
  std::string format = "auto";
  MappingOptions mapping;
};

void map_log(const Args& args) {
  const auto start = Clock::now();
  const Plan plan = make_plan(args.mapping);
  OutDir out(args.mapping.out_dir);
  if (!args.mapping.json.empty() && args.mapping.json != "-") require_writable(args.mapping.json);
  const Log log = read_log(args.logs, args.format);
  const Fused fused = fuse(log, args.mapping, plan);
  write_results(out, log, fused, args.mapping, start, {{"input", args.logs}});
}

}  // namespace

void add_map(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("map", "build a map from a recorded log");
  command->add_option("LOG", args->logs, "CARMEN log (plain or .gz), or the folder or files of an 8-sonar ring")
      ->required();
  command->add_option("--format", args->format, fmt::format("{}", fmt::join(log_formats(), ", ")))
      ->capture_default_str();
  add_mapping_options(*command, args->mapping);
  command->footer(
      "Writes into DIR: map.png; map.yaml and map.pgm (ROS map_server); masses.npy (float32, 4 x height x width: e, o, "
      "u,\n"
      "running sum of conflict; row 0 is the smallest y); report.json (what was used, what was refused and why).\n\n"
      "CARMEN: FLASER, RLASER, ROBOTLASER1 and ROBOTLASER2 are mapped; other records are counted. Values within 5 cm "
      "of\n"
      "the log's largest range mean \"no return\" if there are at least two and they lie beyond 20 m; ranges above "
      "1000 m\n"
      "are refused as absurd. Ring: poses.txt and measurement.txt, matched by time stamp; 5110 mm is no echo.\n\n"
      "Examples:\n"
      "  evigrid map intel.log.gz -o out --cell 0.05 --max-range 10\n"
      "  evigrid map ring/ -o out --rule pcr5 --model li2014\n"
      "  evigrid map intel.log.gz -o out --threads 2 --executor openmp --kernel avx2 --json -\n");
  command->callback([args] { map_log(*args); });
}

}  // namespace evigrid::driver
