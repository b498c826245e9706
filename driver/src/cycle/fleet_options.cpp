// SPDX-License-Identifier: Apache-2.0
#include "cycle/fleet_options.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "error.hpp"
#include "log/line_reader.hpp"
#include "options.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

struct Whole {
  const char* name;
  std::int64_t FleetOptions::*field;
  std::int64_t least, most;
};
struct Real {
  const char* name;
  double FleetOptions::*field;
  double least, most;
  const char* unit;
};

constexpr Whole kWhole[] = {
    {"--robots", &FleetOptions::robots, 1, 10'000'000},   {"--grid", &FleetOptions::grid, 64, 1 << 20},
    {"--cycles", &FleetOptions::cycles, 1, 1'000'000},    {"--warmup", &FleetOptions::warmup, 0, 1'000'000},
    {"--scans", &FleetOptions::scans, 1, 1000},           {"--seed", &FleetOptions::seed, 0, std::int64_t{1} << 53},
    {"--sensors", &FleetOptions::sensors, 0, 1024},       {"--backlog", &FleetOptions::backlog, 0, 100'000'000},
    {"--slice", &FleetOptions::slice, 1, 1'000'000},      {"--most-robots", &FleetOptions::most_robots, 1, 10'000'000},
    {"--memory-mb", &FleetOptions::memory_mb, 1, 1 << 24}};
constexpr Real kReal[] = {{"--deadline-ms", &FleetOptions::deadline_ms, 0.001, 1e6, "ms"},
                          {"--room", &FleetOptions::room_m, 3, 1000, "m"},
                          {"--speed", &FleetOptions::speed_m_s, 0.01, 100, "m/s"}};

/// "deadline-ms" → the row with that name.
template <class Row, std::size_t N>
const Row* find(const Row (&rows)[N], const std::string& name) {
  for (const Row& row : rows)
    if (name == row.name) return &row;
  return nullptr;
}

constexpr std::array<const char*, 6> kSweeps{"robots", "sensors", "grid", "cell", "threads", "scans"};

std::string names_of_sweeps() {
  std::string out;
  for (const char* one : kSweeps) out.append(out.empty() ? "" : ", ").append(one);
  return out;
}

scenes::Scene robot_of(const FleetOptions& o) {
  scenes::Scene robot;
  try {
    scenes::use_robot(robot, o.robot, vocabulary());
  } catch (const scenes::SceneError& error) {
    throw InputError(fmt::format("--robot: {}", error.what()));
  }
  if (o.sensors > 0) {  // the first sonar, again and again around the robot
    if (robot.sonars.empty()) throw InputError(fmt::format("--sensors: {} has no sonar to put around it", o.robot));
    const scenes::SonarSpec first = robot.sonars.front();
    robot.sonars.clear();
    for (std::int64_t i = 0; i < o.sensors; ++i) {
      const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(o.sensors);
      robot.sonars.push_back(first);
      robot.sonars.back().T_robot_sensor = scenes::compose({0, 0, turn}, first.T_robot_sensor);
    }
  }
  if (!o.model.empty() && robot.sonars.empty()) throw InputError(fmt::format("--model: {} has no sonar", o.robot));
  for (scenes::SonarSpec& s : robot.sonars) {
    if (!o.model.empty()) s.model = o.model;
    if (o.max_range_m) s.max_range_m = *o.max_range_m;
    if (o.reliability) s.reliability = *o.reliability;
  }
  for (scenes::LaserSpec& s : robot.lasers) {
    if (o.max_range_m) s.max_range_m = *o.max_range_m;
    if (o.reliability) s.reliability = *o.reliability;
  }
  return robot;
}

void require_conflict_free(const FleetOptions& o, Policy policy) {
  if (o.find_max && policy != Policy::none)
    throw InputError(
        fmt::format("--find-max: looks for the fleet that needs no policy; --policy {} hides it", o.policy));
  if (o.find_max && !o.sweeps.empty()) throw InputError("--find-max: cannot be given beside --sweep");
  if (policy == Policy::skip && o.log.empty() && o.out_dir.empty())
    throw InputError("--policy: skip writes what it skips into a log: give --log FILE or -o DIR");
  if (!o.sweeps.empty() && policy == Policy::skip) throw InputError("--sweep: is for --policy none or backlog");
  if ((o.find_max || !o.sweeps.empty()) && (!o.log.empty() || o.save_map))
    throw InputError("--log and --save-map: are for a single run, without --find-max and --sweep");
  if (o.save_map && o.out_dir.empty()) throw InputError("--save-map: needs -o DIR");
  if (o.backlog > 0 && policy != Policy::backlog) throw InputError("--backlog: is for --policy backlog");
}

}  // namespace

std::vector<Sensor> sensors_of(const scenes::Scene& robot) {
  std::vector<Sensor> out;
  for (const LogSensor& s : declared_sensors(robot)) {
    if (const auto errors = check(s.sensor); !errors.empty())
      throw InputError(fmt::format("robot: {} {}", errors.front().field, errors.front().reason));
    out.push_back(s.sensor);
  }
  return out;
}

FleetPlan plan_fleet(const FleetOptions& o) {
  for (const Whole& w : kWhole)
    if (o.*w.field < w.least || o.*w.field > w.most)
      throw InputError(fmt::format("{}: {} is not within [{}, {}]", w.name, o.*w.field, w.least, w.most));
  for (const Real& r : kReal)
    if (!(o.*r.field >= r.least && o.*r.field <= r.most))
      throw InputError(
          fmt::format("{}: {} is not within [{:g}, {:g}] {}", r.name, o.*r.field, r.least, r.most, r.unit));
  FleetPlan plan;
  plan.policy = parse_policy(o.policy);
  require_conflict_free(o, plan.policy);
  plan.params.rule = parse_map_rule(o.rule);
  plan.params.kernel = parse_kernel(o.kernel);
  plan.params.cell_m = o.cell_m;
  plan.params.memory_cap_bytes = memory_cap(o.memory_mb);
  plan.page_dir = o.page_dir;
  if (const auto errors = check(plan.params); !errors.empty())
    throw InputError(fmt::format("--cell: {} {}", errors.front().field, errors.front().reason));
  if (!o.model.empty() && parse_model(o.model) == Model::beam) throw InputError("--model: beam is for lasers");
  plan.robot = robot_of(o);
  (void)sensors_of(plan.robot);
  plan.executor = parse_executor(o.executor, o.threads);
  return plan;
}

std::vector<Sweep> parse_sweeps(const std::vector<std::string>& texts) {
  std::vector<Sweep> out;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    Sweep sweep{text.substr(0, equals), {}};
    bool known = false;
    for (const char* one : kSweeps) known = known || sweep.what == one;
    if (!known || equals == std::string::npos)
      throw InputError(
          fmt::format("--sweep: '{}' is not NAME=VALUE,VALUE,… with NAME one of {}", text, names_of_sweeps()));
    std::vector<std::string_view> values;
    split_commas(std::string_view(text).substr(equals + 1), values);
    for (const std::string_view value : values) {
      double number = 0;
      if (!parse_number(value, number) || !(number > 0 && number < 1e9) ||
          (sweep.what != "cell" && number != std::floor(number)))
        throw InputError(fmt::format("--sweep: '{}' is no value for {}", value, sweep.what));
      sweep.values.push_back(number);
    }
    out.push_back(std::move(sweep));
  }
  return out;
}

FleetOptions with(FleetOptions o, const std::string& what, double value) {
  if (what == "cell") o.cell_m = value;
  if (what == "threads") o.threads = static_cast<int>(value);
  if (const Whole* row = find(kWhole, "--" + what)) o.*row->field = static_cast<std::int64_t>(value);
  return o;
}

}  // namespace evigrid::driver
