// SPDX-License-Identifier: Apache-2.0
// Names are checked by us and not by the parser of the command line: a rule that is planned but not built, or a kernel
// this processor lacks, deserves a better answer than "not in the list".
#include "options.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include "error.hpp"
#include "evigrid/combine.hpp"
#include "picture/look.hpp"

namespace evigrid::driver {
namespace {

template <class T>
std::string joined(std::span<const T> all) {
  std::string out;
  for (const T one : all) out += (out.empty() ? "" : ", ") + std::string(name(one));
  return out;
}

constexpr Kernel kKernels[] = {Kernel::scalar, Kernel::avx2, Kernel::avx512, Kernel::cuda};
constexpr int kMostThreads = 4096;

}  // namespace

std::string rule_names() { return joined(all_rules()); }
std::string map_rule_names() { return joined(map_rules()); }
std::string different_map_rule_names() {
  std::vector<Rule> out;
  for (const Rule rule : map_rules()) {
    if (same_as(rule) == rule) out.push_back(rule);
  }
  return joined(std::span<const Rule>(out));
}
std::string model_names() { return joined(all_models()); }

Rule parse_rule(const std::string& text) {
  if (const auto rule = rule_from_name(text)) return *rule;
  throw InputError(fmt::format("--rule: '{}' is unknown or not built yet; known: {}", text, rule_names()));
}

Rule parse_map_rule(const std::string& text) {
  const Rule rule = parse_rule(text);
  if (const auto why = why_not_in_maps(rule); !why.empty()) {
    throw InputError(fmt::format("--rule: {} cannot be the rule of a map: {}; use it with combine. For maps: {}", text,
                                 why, map_rule_names()));
  }
  return rule;
}

Model parse_model(const std::string& text) {
  if (const auto model = model_from_name(text)) return *model;
  throw InputError(fmt::format("model '{}' is unknown or not built yet; known: {}", text, model_names()));
}

Kernel parse_kernel(const std::string& text) {
  if (text == "auto" || text == "automatic") return Kernel::automatic;
  std::string here;
  for (const Kernel kernel : kKernels) {
    if (!kernel_available(kernel)) continue;
    if (text == name(kernel)) return kernel;
    here += ", " + std::string(name(kernel));
  }
  if (text == name(Kernel::cuda)) throw InputError("--kernel: cuda cannot run here: " + why_no_cuda());
  throw InputError(fmt::format("--kernel: '{}' is unknown or cannot run here; here: auto{}", text, here));
}

std::shared_ptr<Executor> parse_executor(const std::string& text, int threads) {
  if (threads < 0 || threads > kMostThreads) {
    throw InputError(
        fmt::format("--threads: {} is not within [0, {}] (0: as many as the machine has)", threads, kMostThreads));
  }
  // The program, unlike the library, may say how many threads its process has: --threads 7 then means 7 on any machine.
  struct Permitted {
    tbb::global_control permit;
    std::shared_ptr<Executor> executor;
  };
  if (text == "tbb" && threads > 0) {
    const auto most = static_cast<std::size_t>(threads);
    auto held = std::shared_ptr<Permitted>(
        new Permitted{tbb::global_control(tbb::global_control::max_allowed_parallelism, most), nullptr});
    held->executor = make_executor(text, threads);
    return {held, held->executor.get()};
  }
  if (std::shared_ptr<Executor> executor = make_executor(text, threads)) return executor;
  throw InputError(fmt::format("--executor: '{}' is unknown; known: serial, tbb, openmp, spin", text));
}

std::string describe_outputs() {
  return "Writes into DIR: map.png; map.yaml and map.pgm (ROS map_server); masses.npy (float32, 4 x height x width: e, "
         "o,\n"
         "u, running sum of conflict, then c of rules that keep one; row 0 is the smallest y); map.evigrid (the whole "
         "map, for `evigrid show`, "
         "`evigrid\n"
         "info` and other programs); report.json (what was used, what was refused and why).\n\n"
         "--layers draws numbers with a colour bar (betp to costmap; con and last_conflict make the map keep them, all "
         "does "
         "not),\n"
         "the grey composite and panels of Hughes & Murphy 1992, and Bel(occupied) as a surface.\n\n"
         "--pgm-mode: trinary 0 occupied (BetP > 0.65), 254 free (BetP < 0.196), 205 unknown; scale: grey = 255 (1 - "
         "BetP),\n"
         "a PGM has no way to say unknown there, never seen is 1/2; raw: 0 ... 100 = 100 BetP, 255 never seen.\n\n"
         "--costmap: occupancy.npy (int8, nav_msgs/OccupancyGrid): -1 no information, 0 free, 100 occupied, 1 ... 99\n"
         "between; costmap.npy, costmap.pgm (uint8, costmap_2d): 255 no information, 0 free, 254 lethal, 1 ... 252 "
         "between,\n"
         "253 is left to inflation. Free: BetP < 0.196; occupied: BetP > 0.65; no information: m(unknown) > 0.9.\n\n";
}

std::size_t memory_cap(std::int64_t memory_mb) {
  constexpr std::int64_t kMost = std::int64_t{1} << 24;
  if (memory_mb < 1 || memory_mb > kMost)
    throw InputError(fmt::format("--memory-mb: {} is not within [1, {}]", memory_mb, kMost));
  return static_cast<std::size_t>(memory_mb) << 20;
}

void page_to(Map& map, const std::string& page_dir) {
  if (page_dir.empty()) return;
  try {
    map.page_to(page_dir);
  } catch (const std::exception& bad) {
    throw InputError(fmt::format("--page-dir: {}", bad.what()));
  }
}

void add_mapping_options(CLI::App& command, MappingOptions& o) {
  command.add_option("-o,--out", o.out_dir, "output folder; made when missing")->required();
  command.add_option("--rule", o.rule, "combination rule: " + map_rule_names())->capture_default_str();
  command.add_option("--model", o.model,
                     "sensor model: " + model_names() + " (default: beam for lasers, li2014 for sonars)");
  command
      .add_option("--param", o.params,
                  "MODEL.NAME=VALUE: a parameter of a sensor model, repeatable; `evigrid model --help` lists them")
      ->allow_extra_args(false);
  command.add_option("--decay", o.decay_s,
                     "s: forgetting; a cell keeps exp(-t/SECONDS) of its masses t after the last reading that told it "
                     "something (rules whose cells are masses; 0: never)");
  command.add_option("--dependence", o.dependence,
                     "what readings of one scan are to one another where they overlap: independent, cautious, "
                     "once_per_scan, or\nweighted=EXPONENT in (0, 1] (rules whose cells are masses)");
  command.add_option("--revision", o.revision,
                     "revise what each sonar's model says by this file of `evigrid train` (rules whose cells are "
                     "masses); in place of a\nfixed discount: the default of --reliability is then 1");
  command.add_option("--filter", o.filter,
                     "drop readings before fusing: false_reflection[=METRES], by their neighbours in a ring (Li et al. "
                     "2014; default 0.1), or none");
  command.add_option("--cell", o.cell_m, "side of a cell, m (default: 0.05 for lasers, 0.1 for sonars)");
  command.add_option("--max-range", o.max_range_m, "m: lasers clear up to it, sonar readings beyond it are refused");
  command.add_option("--reliability", o.reliability,
                     "Shafer discount in (0, 1] (default: 1 for lasers, 0.9 for sonars)");
  command
      .add_option("--contextual", o.contextual,
                  "IF_EMPTY,IF_OCCUPIED: reliability where a cell is empty (kept of m(occupied)) and where it is "
                  "occupied (kept of m(empty)), each in (0, 1]")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
  command.add_flag("--clear-no-return", o.clear_no_return, "lasers: a beam without return clears up to --max-range");
  command
      .add_option("--bayes-likelihood", o.bayes_likelihood,
                  "rule bayes: likelihoods of a reading from its masses by betp or plp (plp: Dempster's PlP)")
      ->capture_default_str();
  command.add_option("--bayes-limits", o.bayes_limits, "rule bayes: least,most P(occupied) of a cell (0.001,0.999)")
      ->delimiter(',')
      ->expected(2)
      ->allow_extra_args(false);
  command.add_option("--threads", o.threads, "worker threads; 0: as many as the machine has")->capture_default_str();
  command
      .add_option("--executor", o.executor,
                  "serial, tbb, openmp or spin; the map is the same. spin: threads\nthat look for work for 20 ms "
                  "before they sleep, for single scans at 50 Hz or more")
      ->capture_default_str();
  command.add_option("--kernel", o.kernel, "auto, scalar, avx2, avx512 or cuda; the map is the same")
      ->capture_default_str();
  command.add_option("--json", o.json, "also write report.json to this file; - for standard output");
  command.add_option("--layers", o.layers,
                     "also draw these, comma-separated, or all, as layer_NAME.png: " + look_names());
  command.add_option("--pgm-mode", o.pgm_mode, "how map.pgm holds BetP for ROS map_server: trinary, scale or raw")
      ->capture_default_str();
  command.add_flag("--costmap", o.costmap, "also write costmap.npy, costmap.pgm and occupancy.npy");
  command.add_option("--memory-mb", o.memory_mb, "cap of the map, MiB of its tiles")->capture_default_str();
  command.add_option("--page-dir", o.page_dir,
                     "beyond that cap, tiles that changed longest ago go to a file in this\nfolder, which has no name "
                     "and goes with the process; the map is the same");
  command.add_option("--max-image-mb", o.max_image_mb, "refuse masses and pictures larger than this")
      ->capture_default_str();
}

}  // namespace evigrid::driver
