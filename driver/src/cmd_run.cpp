// SPDX-License-Identifier: Apache-2.0
// evigrid run [SCENE] -o DIR: drive the robot of a scene, cast its readings, map them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands.hpp"
#include "error.hpp"
#include "mapping.hpp"
#include "out/layers.hpp"
#include "picture/truth_picture.hpp"
#include "score/score.hpp"
#include "score/truth.hpp"
#include "simulated.hpp"
#include "world_input.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  WorldOptions input;
  MappingOptions mapping;
};

/// How far the robot's belief about its pose strayed from the truth.
nlohmann::ordered_json odometry_report(const Simulated& run) {
  double largest_m = 0, way_m = 0, error_m = 0, heading_rad = 0;
  for (std::size_t i = 0; i < run.T_map_robot.size(); ++i) {
    const Pose2 &truth = run.T_map_robot[i], &belief = run.log.scans[i].T_map_robot;
    error_m = std::hypot(belief.x_m - truth.x_m, belief.y_m - truth.y_m);
    heading_rad = std::remainder(belief.yaw_rad - truth.yaw_rad, 2 * std::numbers::pi);
    largest_m = std::max(largest_m, error_m);
    if (i > 0) {
      const Pose2& last = run.T_map_robot[i - 1];
      way_m += std::hypot(truth.x_m - last.x_m, truth.y_m - last.y_m);
    }
  }
  return {{"final_position_error_m", error_m},
          {"final_heading_error_deg", heading_rad * 180 / std::numbers::pi},
          {"largest_position_error_m", largest_m},
          {"way_m", way_m}};
}

/// Scores the map and draws truth.png; a world that cannot be scored is no reason to lose its map.
nlohmann::ordered_json against_truth(OutDir& out, const scenes::Scene& scene, const Layers& layers,
                                     const MappingOptions& o) {
  const SceneTruth truth = scene_truth(scene, layers.cell_m);
  if (!truth.grid) return {{"skipped", truth.why_not}};
  const Overlay both = overlay(layers, *truth.grid);
  const Score found = score(layers, *truth.grid, both);
  nlohmann::ordered_json report = to_json(found);
  try {
    out.write("truth.png", png(draw_truth(both, found, layers.cell_m, scene.name, o.max_image_mb)), {});
  } catch (const InputError& large) {
    report["truth.png"] = large.what();
  }
  return report;
}

void run_scene(Args args, bool rule_given) {
  const auto start = Clock::now();
  MappingOptions& o = args.mapping;
  (void)make_plan(o);  // bad options are told before a tour is planned
  const SceneInput input = open_input(args.input);
  if (!rule_given && !input.scene.map.rule.empty())
    o.rule = input.scene.map.rule;  // the command line outranks the scene
  if (!o.cell_m) o.cell_m = input.scene.map.cell_m;
  use_map_options(input.scene, o);
  const Plan plan = make_plan(o);
  OutDir out(o.out_dir);
  if (!o.json.empty() && o.json != "-") require_writable(o.json);
  const Simulated simulated = simulate(input.scene, {.threads = o.threads});
  const Fused fused = fuse(simulated.log, o, plan);
  nlohmann::ordered_json extra{{"input", {input.name}},
                               {"scene", input.scene.name},
                               {"seed", input.scene.trajectory.seed},
                               {"cast_s", simulated.cast_s}};
  if (input.scene.odometry.used) extra["odometry"] = odometry_report(simulated);
  const Layers layers = render_layers(fused.map, o.max_image_mb);
  extra["truth"] = against_truth(out, input.scene, layers, o);
  write_results(out, simulated.log, fused, layers, o, start, extra);
}

}  // namespace

void add_run(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("run", "simulate the robot of a scene and map its readings");
  add_world_options(*command, args->input);
  add_mapping_options(*command, args->mapping);
  command->get_option("--rule")->description("combination rule: " + map_rule_names() +
                                             " (default: the scene's, or pcr5)");
  command->get_option("--cell")->description(
      "side of a cell, m (default: the scene's; in a --world 0.05 with lasers, 0.1 without)");
  command->get_option("--model")->description("sensor model of every sonar (default: each sonar's own)");
  command->get_option("--reliability")
      ->description("Shafer discount in (0, 1] of every sensor (default: each one's own)");
  command->footer(
      "Writes the same files as `evigrid map`, and truth.png: the map over the true world. report.json also has "
      "cast_s,\n"
      "the time of the ray casting; truth, how well the map agrees with the world (docs/maths.md); and, when the "
      "scene\n"
      "has an odometry, how far the believed pose strayed from the true one.\n\n"
      "Examples:\n"
      "  evigrid run -o out\n"
      "  evigrid run li2014 -o out\n"
      "  evigrid run room.toml -o out --rule dempster --model hughes1992 --threads 2\n"
      "  evigrid run room.toml -o out --robot pioneer16\n"
      "  evigrid run -o out --revision revision.json\n"
      "  evigrid run --world willow.yaml -o out --robot laser180 --start 10,20,90\n"
      "  evigrid run --world building -o out --seed 7\n");
  command->callback([args, command] { run_scene(*args, command->count("--rule") > 0); });
}

}  // namespace evigrid::driver
