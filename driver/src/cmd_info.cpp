// SPDX-License-Identifier: Apache-2.0
// evigrid info: what this program is made of and what of it runs here, the first thing to put into a bug report; and
// evigrid info MAP: what a saved map holds.
#include <fmt/format.h>
#include <png.h>
#include <zlib.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bag/bag.hpp"
#include "commands.hpp"
#include "evigrid/evigrid.hpp"
#include "export/octomap_slab.hpp"
#include "given_options.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"
#include "region_option.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;
std::string text_of(const Json& value);

Json facts() {
  Json kernels = Json::array();
  for (const Kernel kernel : {Kernel::scalar, Kernel::avx2, Kernel::avx512, Kernel::cuda}) {
    if (kernel_available(kernel)) kernels.push_back(name(kernel));
  }
  Json rules = Json::array(), models = Json::array();
  for (const Rule rule : all_rules()) rules.push_back(name(rule));
  for (const Model model : all_models()) models.push_back(name(model));
  Json out;
  out["version"] = EVIGRID_VERSION;
  out["maths_version"] = kMathsVersion;
  out["build_type"] = EVIGRID_BUILD_TYPE;
  out["compiler"] = EVIGRID_COMPILER;
  out["kernels_available"] = kernels;
  if (const std::string why = why_no_cuda(); !why.empty()) out["cuda"] = why;
  out["kernel_chosen"] = resolve_kernel_name(Kernel::automatic);
  out["executors"] = {"serial", "tbb", "openmp", "spin"};
  out["threads"] = make_tbb_executor(0)->concurrency();
  out["hardware_threads"] = std::thread::hardware_concurrency();
  out["optional_formats"] = {{"octomap", octomap_is_built()}, {"rosbag", bags_are_built()}};
  out["rules"] = rules;
  out["models"] = models;
  out["packages"] = {{"TBB", EVIGRID_TBB_VERSION},
                     {"Embree", EVIGRID_EMBREE_VERSION},
                     {"zlib", zlibVersion()},
                     {"libpng", png_get_libpng_ver(nullptr)},
                     {"CLI11", CLI11_VERSION},
                     {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                                   NLOHMANN_JSON_VERSION_PATCH)},
                     {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)}};
  return out;
}

Json sensor_facts(const Sensor& s) {
  Json out = {
      {"model", name(s.model)},
      {"mount", {{"x_m", s.T_robot_sensor.x_m}, {"y_m", s.T_robot_sensor.y_m}, {"yaw_rad", s.T_robot_sensor.yaw_rad}}},
      {"min_range_m", s.min_range_m},
      {"max_range_m", s.max_range_m},
      {"no_return_m", s.no_return_m},
      {"reliability", s.reliability}};
  if (s.model == Model::beam) {
    out["beams"] = s.beams;
    out["first_beam_rad"] = s.first_beam_rad;
    out["beam_step_rad"] = s.beam_step_rad;
    out["clear_no_return"] = s.clear_no_return;
  } else {
    out["aperture_rad"] = s.aperture_rad;
  }
  for (const ModelParam& p : model_params(s.model)) {
    const double value = *model_param(s, s.model, p.name);
    out[std::string(p.name)] = p.is_switch ? Json(value != 0) : Json(value);
  }
  return out;
}

Json map_facts(const std::string& path, const std::vector<double>& region_m) {
  const SavedMap saved = open_saved_map(path, nullptr, region_m);
  const MapFileInfo& info = saved.info;
  const CellRect box = saved.map.bounds();
  const double c = info.params.cell_m;
  Json sensors = Json::array();
  for (const Sensor& s : info.sensors) sensors.push_back(sensor_facts(s));
  Json out;
  out["file"] = saved.path;
  out["format_version"] = info.format_version;
  out["maths_version"] = info.maths_version;
  out["rule"] = name(info.params.rule);
  out["cell_m"] = c;
  if (info.params.decay_s > 0) out["decay_s"] = info.params.decay_s;
  out["size_cells"] = {box.width, box.height};
  out["origin_cells"] = {box.x, box.y};
  const auto metres = [&](std::int64_t cell) { return std::round(static_cast<double>(cell) * c * 1e9) / 1e9; };
  out["extent_m"] = {{"x", {metres(box.x), metres(box.x + box.width)}},
                     {"y", {metres(box.y), metres(box.y + box.height)}}};
  out["layers"] = info.planes;
  out["tiles"] = info.tiles;
  out["memory_bytes"] = info.memory_bytes;
  out["file_bytes"] = info.file_bytes;
  out["kernel"] = name(info.params.kernel);
  out["memory_cap_bytes"] = info.params.memory_cap_bytes;
  out["last_stamp_ns"] = info.last_stamp_ns ? Json(*info.last_stamp_ns) : Json();
  out["map_hash"] = fmt::format("{:016x}", region_m.empty() ? saved.map.hash() : info.hash);
  if (!region_m.empty()) {
    const CellRect r = cells_of(region_m, c);
    out["region"] = {{"cells", {r.x, r.y, r.width, r.height}},
                     {"tiles", saved.map.tiles()},
                     {"hash", fmt::format("{:016x}", saved.map.hash())},
                     {"bytes_read", saved.bytes_read}};
  }
  out["sensors"] = sensors;
  return out;
}

/// A ring of sonars differs in its mounts alone: one line for the first of each kind, and how many there are.
void print_map(const Json& all) {
  for (const auto& [key, value] : all.items()) {
    if (key != "sensors") std::cout << fmt::format("{:<18}{}\n", key, text_of(value));
  }
  std::vector<std::pair<Json, int>> kinds;
  for (Json sensor : all["sensors"]) {
    sensor.erase("mount");
    const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.first == sensor; });
    if (same == kinds.end()) {
      kinds.emplace_back(sensor, 1);
    } else {
      ++same->second;
    }
  }
  for (const auto& [sensor, count] : kinds)
    std::cout << fmt::format("{:<18}{} x {}\n", "sensors", count, text_of(sensor));
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  std::string out;
  for (const auto& [key, part] : value.items()) {
    out += (out.empty() ? "" : ", ") + (value.is_object() ? key + " " : std::string()) + text_of(part);
  }
  return out;
}

}  // namespace

void add_info(CLI::App& app) {
  struct Args {
    std::string map, json;
    std::vector<double> region_m;
  };
  auto args = std::make_shared<Args>();
  CLI::App* command =
      app.add_subcommand("info", "version, build, kernels, threads, packages; or what a saved map holds");
  command->add_option("MAP", args->map, "map file (.evigrid), or the folder that map or run wrote");
  command->add_option("--json", args->json, "write the facts to this file as JSON; - for standard output");
  add_region_option(*command, args->region_m);
  command->footer(
      "Of a map: parameters, rule, extent, layers, sensors, hash. It is read whole and every checksum is proved. With\n"
      "--region: size, origin and extent are those of what was seen in that part, which is read alone; region has its "
      "own\ncells, tiles and hash; map_hash is what the file says of the whole.\n\n"
      "Examples:\n  evigrid info\n  evigrid info out\n  evigrid info out/map.evigrid --json -\n"
      "  evigrid info out --region=-2,-2,6,4\n");
  command->callback([args, command] {
    if (args->map.empty()) refuse_given(*command, {"--region"}, "is for a MAP");
    const Json all = args->map.empty() ? facts() : map_facts(args->map, args->region_m);
    const std::string bytes = all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // paths hold any bytes
    if (args->json == "-") {
      std::cout << bytes;
      return;
    }
    if (!args->json.empty()) write_file(args->json, bytes);
    if (!args->map.empty()) return print_map(all);
    for (const auto& [key, value] : all.items()) std::cout << fmt::format("{:<18}{}\n", key, text_of(value));
  });
}

}  // namespace evigrid::driver
