// SPDX-License-Identifier: Apache-2.0
// evigrid map LOG... -o DIR: a recorded log becomes a map.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "bag/frame_options.hpp"
#include "commands.hpp"
#include "error.hpp"
#include "log/readers.hpp"
#include "log/select.hpp"
#include "log/summary.hpp"
#include "mapping.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::vector<std::string> logs;
  std::string format = "auto";
  BagOptions bag;
  std::string scans;                 ///< empty: all
  std::vector<std::string> sensors;  ///< kinds or names; empty: all
  MappingOptions mapping;
  JournalFile journal;
};

/// A log without poses is mapped only where the user says that the robot stood still.
void require_poses(const Log& log, const Args& args) {
  require_plane(log, args.logs.front());
  if (log.poses == Poses::none && args.scans.empty()) {
    throw InputError(
        fmt::format("{}: format {} has no poses: choose what to map with --scans N or A:B ({} scans); the "
                    "robot then stands at the origin",
                    args.logs.front(), log.format, log.scans.size()));
  }
}

void map_log(const Args& args) {
  const auto start = Clock::now();
  const Plan plan = make_plan(args.mapping);
  OutDir out(args.mapping.out_dir);
  if (!args.mapping.json.empty() && args.mapping.json != "-") require_writable(args.mapping.json);
  Log log = read_log(args.logs, args.format, args.bag);
  require_poses(log, args);
  if (!args.scans.empty()) keep_scans(log, args.scans);
  if (!args.sensors.empty()) keep_sensors(log, args.sensors);
  const Fused fused = fuse(log, args.mapping, plan, args.journal);
  nlohmann::ordered_json origin = log_origin(log);
  origin["input"] = args.logs;
  if (!args.scans.empty()) origin["scans_chosen"] = args.scans;
  write_results(out, log, fused, render_layers(fused.map, args.mapping.max_image_mb), args.mapping, start, origin);
}

}  // namespace

void add_map(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("map", "build a map from a recorded log");
  command->add_option("LOG", args->logs, "a log: its file, files or folder, plain or .gz")->required();
  command->add_option("--format", args->format, fmt::format("{}", fmt::join(log_formats(), ", ")))
      ->capture_default_str();
  command->add_option("--scans", args->scans, "map these alone: N, or A:B up to but not including B; from 0");
  command
      ->add_option("--sensors", args->sensors,
                   "map these kinds or names of sensors alone, comma-separated, e.g. sonar,ir")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_bag_options(*command, args->bag);
  add_mapping_options(*command, args->mapping);
  CLI::Option* journal =
      command->add_option("--journal", args->journal.path,
                          "record each scan in this new file before it is fused; a killed run loses nothing");
  command->add_flag("--resume", args->journal.resume, "go on with the --journal of a run that ended early")
      ->needs(journal);
  command->footer(
      describe_outputs() + "Formats (found by content; --format names one):\n" + describe_formats() +
      "\nCARMEN: values within 5 cm of the log's largest range mean \"no return\" if there are at least two and they "
      "lie\nbeyond 20 m; ranges above 1000 m are refused as absurd. Ring: matched by time stamp; 5110 mm is no echo.\n"
      "lego, bigwheelbot: poses by dead reckoning from the origin, they drift. uci24 has no poses: give --scans.\n\n"
      "Examples:\n"
      "  evigrid map intel.log.gz -o out --cell 0.05 --max-range 10\n"
      "  evigrid map ring/ -o out --rule pcr5 --model li2014\n"
      "  evigrid map Garden.txt -o out --sensors sonar --max-range 2.5\n"
      "  evigrid map sensor_readings_24.data -o out --scans 120\n"
      "  evigrid map drive.bag -o out --topics /scan --base-frame base_footprint\n"
      "  evigrid map ring/ -o out --revision revision.json            what `evigrid train` learned of these sonars\n"
      "  evigrid map intel.log.gz -o out --journal intel.journal      and, after a crash, the same with --resume\n"
      "  evigrid map intel.log.gz -o out --threads 2 --executor openmp --kernel avx2 --json -\n");
  command->callback([args] { map_log(*args); });
}

}  // namespace evigrid::driver
