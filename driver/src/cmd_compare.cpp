// SPDX-License-Identifier: Apache-2.0
// evigrid compare INPUT -o DIR: every wished rule × sensor model × robot over one input, in one table and one sheet. A
// scene is cast once per robot, so that all rules see the same readings; its truth gives the scores.
#include <CLI/CLI.hpp>
#include <utility>

#include "bag/frame_options.hpp"
#include "commands.hpp"
#include "compare/compare.hpp"
#include "error.hpp"

namespace evigrid::driver {
namespace {

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : text + ",") {
    if (c != ',' && c != ' ') {
      word += c;
    } else if (!word.empty()) {
      out.push_back(std::exchange(word, {}));
    }
  }
  return out;
}

}  // namespace

void add_compare(CLI::App& app) {
  struct Args {
    CompareOptions options;
    std::string rules = "all", models = "all", robots;
  };
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("compare", "rules, sensor models and robots side by side on one input");
  CompareOptions& o = args->options;
  add_world_options(*command, o.world);
  command->remove_option(command->get_option("SCENE"));
  command->remove_option(command->get_option("--robot"));
  command->add_option("INPUT", o.inputs,
                      "a recorded log, or a scene (a .toml file, or embedded: " + embedded_scene_names() + ")");
  add_bag_options(*command, o.bag);
  add_mapping_options(*command, o.mapping);
  command->remove_option(command->get_option("--rule"));
  command->remove_option(command->get_option("--model"));
  for (const char* single : {"--layers", "--costmap", "--pgm-mode", "--revision"})
    command->remove_option(command->get_option(single));
  command
      ->add_option("--rules", args->rules, "comma-separated, or all (one of those that coincide): " + map_rule_names())
      ->capture_default_str();
  command->add_option("--models", args->models, "sonar models, comma-separated, or all: " + model_names())
      ->capture_default_str();
  command->add_option("--robots", args->robots, "robots for a scene or a --world, comma-separated");
  command->footer(
      "Writes compare.csv, compare.md, report.json and sheet.png. For scenes and plans the truth is known: precision,\n"
      "recall and mistaken rate are given strictly and within one cell (see docs/maths.md). Every rule by every "
      "model,\n"
      "but pairs that do not fit are left out: probability goes with bayes, fuzzy and moravec1985 with fuzzy.\n\n"
      "Examples:\n"
      "  evigrid compare default -o out/compare\n"
      "  evigrid compare intel.log.gz -o out/compare --rules dempster,pcr5 --max-range 10\n"
      "  evigrid compare --world office.yaml -o out/compare --robots hughes24,laser180 --rules pcr5 --models li2014\n");
  command->callback([args] {
    args->options.rules = args->rules == "all" ? split_list(different_map_rule_names()) : split_list(args->rules);
    args->options.models = args->models == "all" ? split_list(model_names()) : split_list(args->models);
    args->options.robots = split_list(args->robots);
    if (!args->robots.empty() && args->options.robots.empty()) throw InputError("--robots: names no robot");
    compare(args->options);
  });
}

}  // namespace evigrid::driver
