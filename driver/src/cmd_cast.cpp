// SPDX-License-Identifier: Apache-2.0
// evigrid cast [SCENE]: the simulated readings as CSV, for other programs and for looking at.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <optional>

#include "commands.hpp"
#include "log/sensor_line.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"
#include "picture/terminal.hpp"
#include "progress.hpp"
#include "simulated.hpp"
#include "world_input.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;  // bytes written at once

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

/// One row a range: of the sonars in their order, then of the beams of each laser.
void add_rows(fmt::memory_buffer& csv, std::size_t number, const scenes::Step& step, const scenes::Step* truth,
              const scenes::Scene& scene) {
  auto to = std::back_inserter(csv);
  const scenes::Pose &p = step.T_map_robot, &belief = step.T_odom_robot;
  const auto row = [&](std::size_t sensor, std::size_t beam, float range_m, float true_m) {
    fmt::format_to(to, "{},{},{},{},{},{},{}", number, step.stamp_ns, p.x_m, p.y_m, p.yaw_rad, sensor, range_m);
    if (truth != nullptr) fmt::format_to(to, ",{}", true_m);
    if (!scene.lasers.empty()) fmt::format_to(to, ",{}", beam);
    if (scene.odometry.used) fmt::format_to(to, ",{},{},{}", belief.x_m, belief.y_m, belief.yaw_rad);
    csv.push_back('\n');
  };
  for (std::size_t i = 0; i < step.ranges_m.size(); ++i)
    row(i, 0, step.ranges_m[i], truth != nullptr ? truth->ranges_m[i] : 0);
  std::size_t at = 0;
  for (std::size_t laser = 0; laser < scene.lasers.size(); ++laser) {
    const auto beams = static_cast<std::size_t>(scene.lasers[laser].beams);
    for (std::size_t beam = 0; beam < beams; ++beam, ++at)
      row(step.ranges_m.size() + laser, beam, step.beams_m[at], truth != nullptr ? truth->beams_m[at] : 0);
  }
}

/// Cast and written in turns, so that a long run takes no more memory than a short one.
void write_readings(Casting& casting, Casting* truth, const Args& args, std::ostream& out) {
  const scenes::Scene& scene = casting.scene();
  fmt::memory_buffer csv;
  auto to = std::back_inserter(csv);
  const auto flush = [&] {
    out.write(csv.data(), static_cast<std::streamsize>(csv.size()));
    csv.clear();
  };
  const std::vector<LogSensor> sensors = declared_sensors(scene);
  for (std::size_t i = 0; args.sensors && i < sensors.size(); ++i)
    fmt::format_to(to, "{}\n", sensor_line(i, sensors[i]));
  fmt::format_to(to, "{}", header(args.truth, !scene.lasers.empty(), scene.odometry.used));
  std::optional<Progress> progress;
  if (!args.out.empty() || !on_terminal()) progress.emplace("casting");  // not among the rows themselves
  for (std::size_t number = 0; out && casting.done() < casting.steps();) {
    const std::vector<scenes::Step> steps = casting.next();
    const std::vector<scenes::Step> true_steps = truth != nullptr ? truth->next() : std::vector<scenes::Step>{};
    for (std::size_t i = 0; i < steps.size(); ++i, ++number) {
      add_rows(csv, number, steps[i], truth != nullptr ? &true_steps[i] : nullptr, scene);
      if (csv.size() >= kPiece) flush();
    }
    if (progress) progress->show(casting.done(), casting.steps());
  }
  flush();
}

void cast(const Args& args) {
  (void)parse_executor("tbb", args.threads);  // tells a bad --threads before any work
  const SceneInput input = open_input(args.input);
  if (!args.out.empty()) require_writable(args.out);
  Casting casting(input.scene, {.threads = args.threads});
  std::optional<Casting> truth;
  if (args.truth) truth.emplace(input.scene, CastOptions{.threads = args.threads, .ideal = true});
  for (const std::string& warning : casting.warnings()) fmt::print(stderr, "evigrid: warning: {}\n", warning);
  const auto write = [&](std::ostream& to) { write_readings(casting, truth ? &*truth : nullptr, args, to); };
  args.out.empty() ? write(std::cout) : write_file_by(args.out, write);
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
