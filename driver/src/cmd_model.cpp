// SPDX-License-Identifier: Apache-2.0
// evigrid model: what one reading says about points of its cone or beam, from the same functions that a map runs.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <numbers>
#include <stdexcept>

#include "commands.hpp"
#include "error.hpp"
#include "evigrid/sensor.hpp"
#include "given_options.hpp"
#include "log/line_reader.hpp"
#include "model_options.hpp"
#include "options.hpp"
#include "revision/network.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

struct Args {
  std::string model;
  double reading_m = 0;
  std::vector<std::string> at;
  double aperture_deg = 25, reliability = 1;
  std::optional<double> max_range_m;
  std::vector<std::string> params;
  double cell_m = 0.05;
  bool grid = false;
  std::string revision;
  std::size_t sensor = 0;
};

/// The network of that sensor, of this model.
Network network_of(const Args& args) {
  for (const Revision& r : read_revisions(args.revision)) {
    if (r.sensor != args.sensor) continue;
    if (r.model != args.model) {
      throw InputError(
          fmt::format("--revision: {} revises {} for sensor {}, not {}", args.revision, r.model, r.sensor, args.model));
    }
    return r.network;
  }
  throw InputError(fmt::format("--sensor: {} holds no sensor {}", args.revision, args.sensor));
}

struct Point {
  double d_m, theta_deg;
};

Point parse_point(const std::string& text) {
  const std::size_t comma = text.find(',');
  Point p{};
  if (comma == std::string::npos || !parse_number(std::string_view(text).substr(0, comma), p.d_m) ||
      !parse_number(std::string_view(text).substr(comma + 1), p.theta_deg)) {
    throw InputError(fmt::format("--at: '{}' is not d,theta_deg", text));
  }
  if (!(p.d_m >= 0 && std::isfinite(p.d_m) && std::isfinite(p.theta_deg)))
    throw InputError(fmt::format("--at: '{}' is no distance, from 0 on, and angle", text));
  return p;
}

/// 33 distances up to a little behind the reading, 17 angles across the opening.
std::vector<Point> grid(const Sensor& s, double reading_m) {
  std::vector<Point> points;
  const double half_deg = (s.model == Model::beam ? s.beam_step_rad : s.aperture_rad) / 2 / kDeg;
  for (int i = 1; i <= 33; ++i) {
    for (int j = -8; j <= 8; ++j) points.push_back({1.1 * reading_m * i / 33, half_deg * j / 8});
  }
  return points;
}

void evaluate_points(const Args& args) {
  Sensor s;
  s.model = parse_model(args.model);
  s.aperture_rad = args.aperture_deg * kDeg;
  s.reliability = args.reliability;
  s.max_range_m = args.max_range_m.value_or(s.model == Model::beam ? 10.0 : s.max_range_m);
  if (s.model == Model::beam) {  // one beam of a fan looks straight ahead
    s.beams = 181;
    s.first_beam_rad = -90 * kDeg;
    s.beam_step_rad = 1 * kDeg;
  }
  const auto settings = parse_settings(args.params, s.model);
  require_used(settings, {args.model});
  apply_settings(settings, s);
  if (!(args.cell_m >= 1e-4 && args.cell_m <= 100)) throw InputError("--cell: must be within [0.0001, 100] m");
  if (const auto errors = check(s); !errors.empty())
    throw InputError(errors.front().field + " " + errors.front().reason);
  const bool within = s.model == Model::beam ? args.reading_m < s.no_return_m : args.reading_m <= s.max_range_m;
  if (!(args.reading_m >= s.min_range_m && within)) {
    throw InputError(fmt::format("--reading: {} m is not within [{}, {}] m (--max-range)", args.reading_m,
                                 s.min_range_m, s.model == Model::beam ? s.no_return_m : s.max_range_m));
  }
  std::vector<Point> points;
  for (const std::string& text : args.at) points.push_back(parse_point(text));
  if (args.grid) {
    for (const Point& p : grid(s, args.reading_m)) points.push_back(p);
  }
  if (points.empty()) throw InputError("--at: no point named; one or more d,theta_deg, or --grid");
  std::optional<Network> network;
  if (!args.revision.empty()) network = network_of(args);
  fmt::memory_buffer csv;
  auto to = std::back_inserter(csv);
  fmt::format_to(to, "d_m,theta_deg,e,o,u,c\n");
  for (const Point& p : points) {
    ModelMass m = evaluate(s, args.reading_m, p.d_m, p.theta_deg * kDeg, args.cell_m);
    if (network && m.u != 1) {  // outside its support the model says nothing, and nothing is revised
      const Gbba r = revise(*network, gbba(m));
      m = {r[0], r[1], r[2], r[3]};
    }
    fmt::format_to(to, "{},{},{:.9g},{:.9g},{:.9g},{:.9g}\n", p.d_m, p.theta_deg, m.e, m.o, m.u, m.c);
  }
  std::cout << std::string_view(csv.data(), csv.size());
}

}  // namespace

void add_model(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("model", "masses that a sensor model gives at points of its cone");
  command->add_option("NAME", args->model, "sensor model: " + model_names())->required();
  command->add_option("--reading", args->reading_m, "measured range, m")->required();
  command->add_option("--at", args->at, "d,theta_deg: distance from the sensor, m, and angle off its axis; repeatable");
  command->add_flag("--grid", args->grid, "a grid of points over the whole cone");
  command->add_option("--aperture", args->aperture_deg, "full opening of a cone, degrees")->capture_default_str();
  command->add_option("--reliability", args->reliability, "Shafer discount in (0, 1]")->capture_default_str();
  command->add_option("--max-range", args->max_range_m, "m (default: 5 for cones, 10 for beam)");
  command->add_option("--param", args->params, "NAME=VALUE: a parameter of the model, repeatable")
      ->allow_extra_args(false);
  command->add_option("--cell", args->cell_m, "side of a cell, m: moravec1985 shares o among the cells of its arc")
      ->capture_default_str();
  CLI::Option* revision =
      command->add_option("--revision", args->revision, "revise the masses by this file of `evigrid train`");
  command->add_option("--sensor", args->sensor, "which sensor of that file")->capture_default_str()->needs(revision);
  command->footer(
      "Writes CSV d_m,theta_deg,e,o,u,c: masses of empty, occupied, unknown, and the paradoxical mass of li2006 and\n"
      "li2014. probability: e = 1 - P, o = P. fuzzy, moravec1985: e and o are memberships, u = (1-e)(1-o) neither, c = "
      "e*o\n"
      "both; no masses. Outside the model's support: 0,0,1,0.\n\n" +
      describe_model_params() +
      "\n"
      "Examples:\n"
      "  evigrid model li2014 --reading 1.493 --at 1.5,0\n"
      "  evigrid model hughes1992 --reading 2 --at 1,0 --at 2,5 --aperture 30\n"
      "  evigrid model li2006 --reading 1.5 --at 1.2,0 --param epsilon_m=0.05\n"
      "  evigrid model moravec1985 --reading 2 --at 1,0 --at 2,0 --cell 0.1\n"
      "  evigrid model beam --reading 3 --grid > beam.csv\n");
  command->callback([args, command] {
    if (args->model == name(Model::beam)) refuse_given(*command, {"--aperture"}, "is for cones; a beam has none");
    evaluate_points(*args);
  });
}

}  // namespace evigrid::driver
