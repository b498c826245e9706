// SPDX-License-Identifier: Apache-2.0
// evigrid cast [SCENE]: the simulated readings as CSV, for other programs and for looking at.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>

#include "commands.hpp"
#include "log/sensor_line.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"
#include "world_input.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  WorldOptions input;
  std::string out;
  int threads = 0;
  bool truth = false, sensors = false;
};

/// Columns that not every scene has come last, so that the first ones keep their places.
std::string header(bool truth, bool lasers, bool odometry) {
  return fmt::format("step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m{}{}{}\n", truth ? ",truth" : "",
                     lasers ? ",beam" : "", odometry ? ",odom_x_m,odom_y_m,odom_yaw_rad" : "");
}

void cast(const Args& args) {
  (void)parse_executor("tbb", args.threads);  // tells a bad --threads before any work
  const SceneInput input = open_input(args.input);
  if (!args.out.empty()) require_writable(args.out);
  const Simulated run = simulate(input.scene, {.threads = args.threads});
  const Log& log = run.log;
  const Log truth = args.truth ? simulate(input.scene, {.threads = args.threads, .ideal = true}).log : Log{};
  const bool lasers = !input.scene.lasers.empty(), odometry = input.scene.odometry.used;
  fmt::memory_buffer csv;
  auto to = std::back_inserter(csv);
  for (std::size_t i = 0; args.sensors && i < log.sensors.size(); ++i)
    fmt::format_to(to, "{}\n", sensor_line(i, log.sensors[i]));
  fmt::format_to(to, "{}", header(args.truth, lasers, odometry));
  for (std::size_t step = 0; step < log.scans.size(); ++step) {
    const LogScan& scan = log.scans[step];
    const Pose2 &p = run.T_map_robot[step], &belief = scan.T_map_robot;
    for (std::size_t i = scan.first; i < scan.first + scan.count; ++i) {
      const LogReading& r = log.readings[i];
      for (std::size_t beam = 0; beam < r.count; ++beam) {
        fmt::format_to(to, "{},{},{},{},{},{},{}", step, scan.stamp_ns, p.x_m, p.y_m, p.yaw_rad, r.sensor,
                       log.ranges_m[r.first + beam]);
        if (args.truth) fmt::format_to(to, ",{}", truth.ranges_m[r.first + beam]);
        if (lasers) fmt::format_to(to, ",{}", beam);
        if (odometry) fmt::format_to(to, ",{},{},{}", belief.x_m, belief.y_m, belief.yaw_rad);
        csv.push_back('\n');
      }
    }
  }
  const std::string_view bytes(csv.data(), csv.size());
  args.out.empty() ? void(std::cout << bytes) : write_file(args.out, bytes);
}

}  // namespace

void add_cast(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("cast", "the readings of a simulated run as CSV");
  add_world_options(*command, args->input);
  command->add_option("-o,--out", args->out, "write to this file instead of standard output");
  command->add_flag("--truth", args->truth, "add a column with the range without noise, second bounce and cross-talk");
  command->add_flag("--sensors", args->sensors,
                    "begin with a comment line a sensor: with them `evigrid map` maps the file");
  command->add_option("--threads", args->threads, "for casting; 0: as many as the machine has; same readings")
      ->capture_default_str();
  command->footer(
      "Columns: step,stamp_ns,x_m,y_m,yaw_rad,sensor,range_m[,truth][,beam][,odom_x_m,odom_y_m,odom_yaw_rad].\n"
      "x_m, y_m, yaw_rad: the true pose of the robot in the map; odom_...: the one it believes in, when the scene has "
      "an\n"
      "odometry. sensor: sonars first, then lasers. beam: one row a beam, when there are lasers; 0 for sonars.\n"
      "inf: no echo; -inf: nearer than the sensor measures.\n\n"
      "Examples:\n"
      "  evigrid cast room.toml > readings.csv\n"
      "  evigrid cast asharif2001 --threads 2 -o readings.csv\n"
      "  evigrid cast --truth -o readings.csv\n"
      "  evigrid cast room.toml --sensors -o readings.csv      and evigrid map readings.csv -o out\n");
  command->callback([args] { cast(*args); });
}

}  // namespace evigrid::driver
