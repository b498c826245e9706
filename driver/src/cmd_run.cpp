// SPDX-License-Identifier: Apache-2.0
// evigrid run [SCENE.toml] -o DIR: drive the robot of a scene, cast its readings, map them.
#include "commands.hpp"
#include "mapping.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string scene;
  MappingOptions mapping;
};

void run_scene(Args args, bool rule_given) {
  const auto start = Clock::now();
  const SceneInput input = open_scene(args.scene);
  MappingOptions& o = args.mapping;
  if (!rule_given && !input.scene.map.rule.empty())
    o.rule = input.scene.map.rule;  // the command line outranks the scene
  if (!o.cell_m) o.cell_m = input.scene.map.cell_m;
  const Plan plan = make_plan(o);
  OutDir out(o.out_dir);
  if (!o.json.empty() && o.json != "-") require_writable(o.json);
  const Simulated simulated = simulate(input.scene);
  const Fused fused = fuse(simulated.log, o, plan);
  write_results(out, simulated.log, fused, o, start,
                {{"input", {input.name}},
                 {"scene", input.scene.name},
                 {"seed", input.scene.trajectory.seed},
                 {"cast_s", simulated.cast_s}});
}

}  // namespace

void add_run(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("run", "simulate the robot of a scene and map its readings");
  command->add_option("SCENE", args->scene, "scene file (TOML); without one the embedded scene, a furnished room");
  add_mapping_options(*command, args->mapping);
  command->get_option("--rule")->description("combination rule: " + rule_names() + " (default: the scene's)");
  command->get_option("--cell")->description("side of a cell, m (default: the scene's)");
  command->get_option("--model")->description("sensor model of every sonar (default: each sonar's own)");
  command->get_option("--reliability")
      ->description("Shafer discount in (0, 1] of every sonar (default: each sonar's own)");
  command->footer(
      "Writes the same files as `evigrid map`; report.json also has cast_s, the time of the ray casting.\n\n"
      "Examples:\n"
      "  evigrid run -o out\n"
      "  evigrid run room.toml -o out --rule dempster --model hughes1992 --threads 2\n");
  command->callback([args, command] { run_scene(*args, command->count("--rule") > 0); });
}

}  // namespace evigrid::driver
