// SPDX-License-Identifier: Apache-2.0
// evigrid info: what this program is made of and what of it runs here. The first thing to put into a bug report.
#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands.hpp"
#include "evigrid/evigrid.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;

Json facts() {
  Json kernels = Json::array();
  for (const Kernel kernel : {Kernel::scalar, Kernel::avx2, Kernel::avx512}) {
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
  out["kernel_chosen"] = resolve_kernel_name(Kernel::automatic);
  out["executors"] = {"serial", "tbb", "openmp"};
  out["threads"] = make_tbb_executor(0)->concurrency();
  out["hardware_threads"] = std::thread::hardware_concurrency();
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
  auto json = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("info", "version, build, kernels, threads, packages");
  command->add_option("--json", *json, "write the facts to this file as JSON; - for standard output");
  command->footer("Examples:\n  evigrid info\n  evigrid info --json -\n");
  command->callback([json] {
    const Json all = facts();
    if (*json == "-") {
      std::cout << all.dump(2) << '\n';
      return;
    }
    if (!json->empty()) write_file(*json, all.dump(2) + "\n");
    for (const auto& [key, value] : all.items()) std::cout << fmt::format("{:<18}{}\n", key, text_of(value));
  });
}

}  // namespace evigrid::driver
