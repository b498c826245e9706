// SPDX-License-Identifier: Apache-2.0
#include "export/planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "error.hpp"
#include "evigrid/combine.hpp"

namespace evigrid::driver {
namespace {

constexpr std::pair<std::string_view, Layer> kMasses[] = {
    {"e", Layer::empty}, {"o", Layer::bel}, {"u", Layer::unknown}, {"c", Layer::paradox}};

std::optional<Layer> layer_named(const std::string& name) {
  for (const auto& [letter, layer] : kMasses) {
    if (name == letter) return layer;
  }
  return layer_from_name(name);
}

bool is_kept(Layer layer, const MapParams& params) {
  switch (layer) {
    case Layer::conflict:
      return params.keep_conflict;
    case Layer::con:
      return params.keep_con;
    case Layer::last_conflict:
      return params.keep_last_conflict;
    default:
      return true;
  }
}

}  // namespace

std::string plane_choices() {
  std::string out = "e, o, u, c (the masses)";
  for (const Layer layer : all_layers()) out += ", " + std::string(name(layer));
  return out;
}

std::vector<ExportPlane> parse_planes(const std::vector<std::string>& names, const MapParams& params) {
  std::vector<ExportPlane> out;
  for (const std::string& name : names) {
    const std::optional<Layer> layer = layer_named(name);
    if (!layer) throw InputError(fmt::format("--planes: '{}' is unknown; known: {}", name, plane_choices()));
    if (std::any_of(out.begin(), out.end(), [&](const ExportPlane& p) { return p.name == name; }))
      throw InputError(fmt::format("--planes: '{}' is given twice", name));
    if (!is_kept(*layer, params)) throw InputError(fmt::format("--planes: this map keeps no {}", name));
    out.push_back({name, *layer});
  }
  return out;
}

std::vector<ExportPlane> standard_planes(const MapParams& params) {
  std::vector<ExportPlane> out{{"e", Layer::empty}, {"o", Layer::bel}, {"u", Layer::unknown}};
  if (keeps_paradox(params.rule)) out.push_back({"c", Layer::paradox});
  out.push_back({"betp", Layer::betp});
  for (const Layer layer : {Layer::conflict, Layer::con, Layer::last_conflict}) {
    if (is_kept(layer, params)) out.push_back({std::string(name(layer)), layer});
  }
  return out;
}

}  // namespace evigrid::driver
