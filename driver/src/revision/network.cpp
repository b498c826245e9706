// SPDX-License-Identifier: Apache-2.0
#include "revision/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr const char* kFormat = "evigrid revision 1";

}  // namespace

Gbba gbba(const ModelMass& m) { return {m.e, m.o, m.u, m.c}; }

Gbba revise(const Network& network, const Gbba& m) { return gbba(evigrid::revise(network, {m[0], m[1], m[2], m[3]})); }

std::string to_text(const std::vector<Revision>& revisions) {
  nlohmann::ordered_json out{{"format", kFormat}, {"sensors", nlohmann::ordered_json::array()}};
  for (const Revision& r : revisions)
    out["sensors"].push_back({{"sensor", r.sensor}, {"model", r.model}, {"weights", r.network.weight}});
  return out.dump(1) + "\n";
}

std::vector<Revision> read_revisions(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(path + ": is a folder, no file of `evigrid train`");
  errno = 0;
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  const auto fail = [&](const std::string& why) { throw InputError(path + ": " + why); };
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(file, nullptr, false);
  } catch (const std::ios_base::failure&) {  // of the file itself
    fail("cannot be read");
  }
  if (!json.is_object() || json.value("format", nlohmann::json()) != kFormat)
    fail("is no file of `evigrid train` (format: " + std::string(kFormat) + ")");
  const auto sensors = json.find("sensors");
  if (sensors == json.end() || !sensors->is_array() || sensors->empty()) fail("sensors: none");
  std::vector<Revision> out;
  for (const auto& one : *sensors) {
    const std::string where = fmt::format("sensors[{}].", out.size());
    if (!one.is_object()) fail(where + ": is no object");
    const auto field = [&](const char* key) {
      const auto found = one.find(key);
      if (found == one.end()) fail(where + key + ": is missing");
      return *found;
    };
    Revision r;
    const auto number = field("sensor"), model = field("model"), weights = field("weights");
    if (!number.is_number_unsigned()) fail(where + "sensor: is no whole number from 0");
    if (!model.is_string() || !model_from_name(model.get<std::string>())) fail(where + "model: is unknown");
    if (!weights.is_array() || weights.size() != r.network.weight.size())
      fail(fmt::format("{}weights: must be {} numbers", where, Network::kWeights));
    r.sensor = number.get<std::size_t>();
    r.model = model.get<std::string>();
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (!weights[i].is_number() || !(std::abs(weights[i].get<double>()) <= Network::kMostWeight))
        fail(fmt::format("{}weights[{}]: is no number within ±{:g}", where, i, Network::kMostWeight));
      r.network.weight[i] = weights[i].get<double>();
    }
    out.push_back(std::move(r));
  }
  return out;
}

void apply_revision(const std::vector<Revision>& all, const std::string& path, std::size_t index, Sensor& sensor) {
  if (all.empty() || sensor.model == Model::beam) return;
  const auto own = std::find_if(all.begin(), all.end(), [&](const Revision& r) { return r.sensor == index; });
  if (own == all.end() && all.size() > 1)
    throw InputError(fmt::format("--revision: {} holds no sensor {}", path, index));
  const Revision& r = own == all.end() ? all.front() : *own;
  if (r.model != name(sensor.model)) {
    throw InputError(fmt::format("--revision: {} revises {} for sensor {}, which has the model {}", path, r.model,
                                 index, name(sensor.model)));
  }
  sensor.revision = std::make_shared<const RevisionNetwork>(r.network);
}

}  // namespace evigrid::driver
