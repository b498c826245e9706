// SPDX-License-Identifier: Apache-2.0
// evigrid merge A B ... -o DIR: saved maps of one place, or of neighbouring ones, as one map.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.hpp"
#include "error.hpp"
#include "evigrid/merge.hpp"
#include "options.hpp"
#include "out/layers.hpp"
#include "out/out_dir.hpp"
#include "picture/map_picture.hpp"
#include "progress.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;

struct Args {
  std::vector<std::string> maps, poses;
  std::vector<double> reliability;
  std::string out, json, executor = "tbb";
  int threads = 0, max_image_mb = 2048;
};

struct Part {
  std::string path;
  Pose2 pose;
  double reliability = 1;
};

/// "x,y,theta": m, m, degrees.
Pose2 parse_pose(const std::string& text) {
  Pose2 out;
  double* const to[3]{&out.x_m, &out.y_m, &out.yaw_rad};
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find(',', at) : text.size();
    try {
      if (end == std::string::npos) throw std::invalid_argument(text);
      std::size_t used = 0;
      const std::string one = text.substr(at, end - at);
      *to[i] = std::stod(one, &used);
      if (used != one.size()) throw std::invalid_argument(text);
    } catch (const std::logic_error&) {
      throw InputError(fmt::format("--pose: '{}' is not x,y,theta in m, m and degrees", text));
    }
    at = end + 1;
  }
  out.yaw_rad *= std::numbers::pi / 180;
  return out;
}

/// What belongs to each map after the first.
std::vector<Part> parts_of(const Args& args) {
  const std::size_t n = args.maps.size() - 1;
  if (!args.poses.empty() && args.poses.size() != n)
    throw InputError(fmt::format("--pose: given {} times, for {} maps after the first", args.poses.size(), n));
  if (args.reliability.size() > 1 && args.reliability.size() != n)
    throw InputError(
        fmt::format("--reliability: given {} times, for {} maps after the first", args.reliability.size(), n));
  std::vector<Part> out;
  for (std::size_t i = 0; i < n; ++i) {
    Part part{args.maps[i + 1], {}, 1};
    if (!args.poses.empty()) part.pose = parse_pose(args.poses[i]);
    if (!args.reliability.empty()) part.reliability = args.reliability[args.reliability.size() == 1 ? 0 : i];
    if (!(part.reliability > 0 && part.reliability <= 1))
      throw InputError(fmt::format("--reliability: {} is not within (0, 1]", part.reliability));
    out.push_back(part);
  }
  return out;
}

/// Of one step.
Json step(const SavedMap& from, const Part& part, const MergeReport& r) {
  return {{"file", from.path},
          {"map_hash", fmt::format("{:016x}", from.info.hash)},
          {"pose", {part.pose.x_m, part.pose.y_m, part.pose.yaw_rad}},
          {"reliability", part.reliability},
          {"aligned", r.aligned},
          {"cells", r.cells},
          {"total_conflicts", r.total_conflicts},
          {"max_conflict", r.max_conflict}};
}

void merge_maps(const Args& args) {
  if (args.maps.size() < 2) throw InputError("merge takes at least two maps");
  const std::vector<Part> parts = parts_of(args);
  if (args.max_image_mb <= 0) throw InputError(fmt::format("--max-image-mb: {} is not above 0", args.max_image_mb));
  const std::shared_ptr<Executor> executor = parse_executor(args.executor, args.threads);
  OutDir out(args.out);
  if (!args.json.empty() && args.json != "-") require_writable(args.json);
  SavedMap first = open_saved_map(args.maps[0], executor);
  Map& into = first.map;
  into.set_window({});  // the whole of both, whatever the first one was driven with
  Json steps = Json::array();
  Progress progress("merging");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    SavedMap from = open_saved_map(parts[i].path, executor);
    try {
      steps.push_back(step(from, parts[i], merge(into, from.map.view(), {parts[i].pose, parts[i].reliability})));
    } catch (const std::invalid_argument& bad) {
      throw InputError(fmt::format("{}: {}", from.path, bad.what()));
    } catch (const std::length_error& full) {
      throw InputError(fmt::format("the map grows beyond its memory cap: {}", full.what()));
    }
    progress.show(i + 1, parts.size());
  }
  const Layers layers = render_layers(into, args.max_image_mb);
  if (layers.rect.empty()) throw InputError("all maps are without a single reading, there is nothing to merge");
  const std::string hash = fmt::format("{:016x}", into.hash());
  const PictureText text{"evigrid merge: " + describe_map(first),
                         fmt::format("map hash {}, {} maps, {} x {} cells", hash, args.maps.size(), layers.rect.width,
                                     layers.rect.height)};
  out.write("map.png", png(draw_map(layers, {}, text, {0, args.max_image_mb, "map.png"})), {});
  const std::string head = npy_head(layers);
  out.write("masses.npy", std::as_bytes(std::span(head)), std::as_bytes(std::span(layers.planes)));
  out.write("map.pgm", pgm(layers));
  out.write("map.yaml", map_yaml(layers, "map.pgm"));
  out.write_by(kMapFile, [&](std::ostream& file) { save(into, file); });
  const Json report{{"rule", name(into.params().rule)},
                    {"cell_m", into.params().cell_m},
                    {"size_cells", {layers.rect.width, layers.rect.height}},
                    {"origin_cells", {layers.rect.x, layers.rect.y}},
                    {"map_hash", hash},
                    {"maths_version", kMathsVersion},
                    {"first", {{"file", first.path}, {"map_hash", fmt::format("{:016x}", first.info.hash)}}},
                    {"merged", steps},
                    {"tiles", into.tiles()},
                    {"memory_bytes", into.memory_bytes()}};
  const std::string bytes = report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  out.write("report.json", bytes);
  if (!args.json.empty() && args.json != "-") out.write_outside(args.json, bytes);
  out.commit();
  if (args.json == "-") {
    std::cout << bytes;
    return;
  }
  for (const Json& s : steps) {
    std::cout << fmt::format("{}: {} cells combined{}, largest conflict {:.3g}\n", s["file"].get<std::string>(),
                             s["cells"].get<std::uint64_t>(), s["aligned"].get<bool>() ? ", cell on cell" : "",
                             s["max_conflict"].get<float>());
  }
  std::cout << fmt::format("{}: {} x {} cells, map hash {}\n", out.path().string(), layers.rect.width,
                           layers.rect.height, hash);
}

}  // namespace

void add_merge(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("merge", "several saved maps as one, each with its pose and reliability");
  command
      ->add_option("MAP", args->maps,
                   "map files (.evigrid) or folders that map or run wrote; the first gives the frame")
      ->required();
  command->add_option("-o,--out", args->out, "output folder; made when missing")->required();
  command
      ->add_option("--pose", args->poses,
                   "x,y,theta (m, m, degrees): where the frame of a further map lies in the first one's; once for each "
                   "(default 0,0,0)")
      ->allow_extra_args(false);
  command
      ->add_option("--reliability", args->reliability,
                   "Shafer discount in (0, 1] of a further map; once for all, or once for each (default 1)")
      ->allow_extra_args(false);
  command->add_option("--threads", args->threads, "worker threads; 0: as many as the machine has")
      ->capture_default_str();
  command->add_option("--executor", args->executor, "serial, tbb, openmp or spin; the map is the same")
      ->capture_default_str();
  command->add_option("--json", args->json, "also write report.json to this file; - for standard output");
  command->add_option("--max-image-mb", args->max_image_mb, "refuse masses and pictures larger than this")
      ->capture_default_str();
  command->footer(
      "Maps are taken in the order given, by the first one's rule; cells must be of one size. A shift by whole cells "
      "is\n"
      "exact; of any other pose each cell takes what lies under its centre. Writes into DIR: map.evigrid, map.png,\n"
      "masses.npy, map.pgm, map.yaml, report.json. docs/life_of_a_map.md says what merging means under each rule.\n\n"
      "Examples:\n"
      "  evigrid merge robot1 robot2 robot3 -o all\n"
      "  evigrid merge monday tuesday -o both --reliability 0.8\n"
      "  evigrid merge a b c -o all --pose 12.5,0,0 --pose=-3,4.25,90 --json -\n");
  command->callback([args] { merge_maps(*args); });
}

}  // namespace evigrid::driver
