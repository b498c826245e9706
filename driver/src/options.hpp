// SPDX-License-Identifier: Apache-2.0
// The options that several commands share, as the user gave them, and their translation into the engine's words.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include "cli.hpp"

#include "evigrid/executor.hpp"
#include "evigrid/map.hpp"
#include "evigrid/types.hpp"

namespace evigrid::driver {

struct MappingOptions {
  std::string out_dir;
  std::string rule = "pcr5";
  std::string model;  ///< empty: beam for lasers, li2014 for sonars
  std::optional<double> cell_m, max_range_m, reliability;
  std::vector<std::string> params;      ///< of sensor models: MODEL.NAME=VALUE
  bool params_of_other_models = false;  ///< compare gives each row those of all rows
  std::optional<double> decay_s;        ///< empty: the scene's, or never
  std::string dependence;               ///< of a scan's readings; empty: the scene's, or independent
  std::string revision;                 ///< a file of `evigrid train`; empty: none
  std::string filter;                   ///< of readings; empty: the scene's, or none
  std::vector<double> contextual;       ///< empty, or reliability if empty and if occupied
  bool clear_no_return = false;
  std::string bayes_likelihood = "betp";
  std::vector<double> bayes_limits;  ///< empty, or least and most P(occupied)
  int threads = 0;
  std::string executor = "tbb";
  std::string kernel = "auto";
  std::string json;  ///< empty: only DIR/report.json
  int max_image_mb = 2048;
  std::int64_t memory_mb = 4096;     ///< cap of the map
  std::string page_dir;              ///< where cold tiles go beyond it; empty: nowhere
  std::string layers;                ///< looks to draw besides map.png; "all"
  std::string pgm_mode = "trinary";  ///< of map.pgm
  bool costmap = false;
};

/// Throws InputError when --memory-mb is not a size.
std::size_t memory_cap(std::int64_t memory_mb);
/// --page-dir, empty: none. Throws InputError naming it.
void page_to(Map& map, const std::string& page_dir);
/// What to do when --memory-mb is too little, for the end of a message.
inline constexpr const char* kMoreRoom =
    "more of --memory-mb, a --page-dir, a larger --cell or a shorter --max-range helps";

void add_mapping_options(CLI::App& command, MappingOptions& options);
/// What map and run write into DIR, for their --help.
std::string describe_outputs();

/// Each throws InputError naming the option, the value and the known names.
Rule parse_rule(const std::string& name);
Rule parse_map_rule(const std::string& name);  ///< also refuses the rules that need more than a map keeps
Model parse_model(const std::string& name);
Kernel parse_kernel(const std::string& name);
std::shared_ptr<Executor> parse_executor(const std::string& name, int threads);

/// The names of all rules (models) that are built, comma-separated.
std::string rule_names();
std::string map_rule_names();
std::string different_map_rule_names();  ///< of rules that coincide, the first
std::string model_names();

}  // namespace evigrid::driver
