// SPDX-License-Identifier: Apache-2.0
// evigrid cast SCENE.toml: the simulated readings as CSV, for other programs and for looking at.
#include <fmt/format.h>

#include <iostream>

#include "commands.hpp"
#include "out/out_dir.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string scene, out;
  bool truth = false;
};

void cast(const Args& args) {
  const SceneInput input = open_scene(args.scene);
  if (!args.out.empty()) require_writable(args.out);
  const Log log = simulate(input.scene).log;
  const Log truth = args.truth ? simulate(input.scene, true).log : Log{};
  fmt::memory_buffer csv;
  auto to = std::back_inserter(csv);
  fmt::format_to(to, "step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m{}\n", args.truth ? ",truth" : "");
  for (std::size_t step = 0; step < log.scans.size(); ++step) {
    const LogScan& scan = log.scans[step];
    const Pose2& p = scan.T_map_robot;
    for (std::size_t i = scan.first; i < scan.first + scan.count; ++i) {
      const LogReading& r = log.readings[i];
      fmt::format_to(to, "{},{},{},{},{},{},{}", step, scan.stamp_ns, p.x_m, p.y_m, p.yaw_rad, r.sensor,
                     log.ranges_m[r.first]);
      if (args.truth) fmt::format_to(to, ",{}", truth.ranges_m[r.first]);
      csv.push_back('\n');
    }
  }
  const std::string_view bytes(csv.data(), csv.size());
  args.out.empty() ? void(std::cout << bytes) : write_file(args.out, bytes);
}

}  // namespace

void add_cast(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("cast", "the readings of a simulated run as CSV");
  command->add_option("SCENE", args->scene, "scene file (TOML); without one the embedded scene");
  command->add_option("-o,--out", args->out, "write to this file instead of standard output");
  command->add_flag("--truth", args->truth, "add a column with the range without noise");
  command->footer(
      "Columns: step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m[,truth]; x_m, y_m, yaw_rad: the robot in the map.\n"
      "inf: no echo; -inf: nearer than the sensor measures.\n\n"
      "Examples:\n"
      "  evigrid cast room.toml > readings.csv\n"
      "  evigrid cast --truth -o readings.csv\n");
  command->callback([args] { cast(*args); });
}

}  // namespace evigrid::driver
