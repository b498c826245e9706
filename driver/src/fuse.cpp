// SPDX-License-Identifier: Apache-2.0
// The engine at work on a log: declare the sensors, hand over the scans in line order, batch by batch.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "error.hpp"
#include "map_journal.hpp"
#include "mapping.hpp"
#include "model_options.hpp"
#include "out/layers.hpp"
#include "picture/look.hpp"
#include "progress.hpp"
#include "revision/network.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kBatch = 128;  // scans a call: the engine's tiles stay warm, progress stays smooth

std::string listed(const std::vector<ParamError>& errors) {
  std::string out;
  for (const ParamError& error : errors) out += (out.empty() ? "" : "; ") + error.field + " " + error.reason;
  return out;
}

}  // namespace

void require_plane(const Log& log, const std::string& named) {
  if (log.poses != Poses::one_dimension) return;
  throw InputError(
      fmt::format("{}: format {} is a drive along a line with true ranges, not a map's log: see "
                  "`evigrid calibrate`",
                  named, log.format));
}

Report integrate_what_fits(Map& map, std::span<const Scan> scans, bool pages) {
  try {
    return map.integrate(scans);
  } catch (const std::length_error&) {
    if (!pages || scans.size() < 2) throw;
  }
  Report report = integrate_what_fits(map, scans.first(scans.size() / 2), pages);
  report += integrate_what_fits(map, scans.subspan(scans.size() / 2), pages);
  return report;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Plan make_plan(const MappingOptions& o) {
  Plan plan;
  plan.params.rule = parse_map_rule(o.rule);
  plan.params.kernel = parse_kernel(o.kernel);
  if (!o.model.empty()) parse_model(o.model);
  (void)parse_settings(o.params);
  plan.params.false_reflection_m = parse_filter(o.filter);
  if (o.decay_s) plan.params.decay_s = *o.decay_s;
  if (o.cell_m) plan.params.cell_m = *o.cell_m;
  const auto likelihood = likelihood_from_name(o.bayes_likelihood);
  if (!likelihood)
    throw InputError(fmt::format("--bayes-likelihood: '{}' is unknown; known: betp, plp", o.bayes_likelihood));
  plan.params.bayes.likelihood = *likelihood;
  if (o.bayes_limits.size() == 2) {
    plan.params.bayes.least_p = o.bayes_limits[0];
    plan.params.bayes.most_p = o.bayes_limits[1];
  }
  if (o.layers != "all") {
    for (const Look look : parse_looks("--layers", o.layers)) {
      plan.params.keep_con |= look == Look::con;
      plan.params.keep_last_conflict |= look == Look::last_conflict;
    }
  }
  if (const auto errors = check(plan.params); !errors.empty()) throw InputError(listed(errors));
  plan.params.memory_cap_bytes = memory_cap(o.memory_mb);
  if (o.max_image_mb <= 0) throw InputError(fmt::format("--max-image-mb: {} is not above 0", o.max_image_mb));
  parse_pgm_mode(o.pgm_mode);
  plan.executor = parse_executor(o.executor, o.threads);
  return plan;
}

Sensor configured(const LogSensor& from_log, const MappingOptions& o, bool mixed) {
  Sensor s = from_log.sensor;
  const bool fan = s.model == Model::beam;
  if (!o.model.empty()) {
    const Model wanted = parse_model(o.model);
    const bool fits = (wanted == Model::beam) == fan;
    if (!fits && !mixed) {
      throw InputError(fmt::format("--model: {} is for {}, this input holds {}", name(wanted),
                                   wanted == Model::beam ? "laser fans" : "sonar cones",
                                   fan ? "laser fans" : "sonar cones"));
    }
    if (fits) s.model = wanted;  // of lasers and sonars together, those of its kind are meant
  }
  apply_settings(parse_settings(o.params), s);
  if (o.max_range_m) s.max_range_m = *o.max_range_m;
  if (fan) {  // beyond what the scanner can tell from "no return" there is nothing to clear
    s.max_range_m = std::min(s.max_range_m, s.no_return_m);
    s.clear_no_return |= o.clear_no_return;
  } else if (o.clear_no_return && !mixed) {
    throw InputError(
        "--clear-no-return: is for lasers; a sonar that hears no echo does not show that its cone is empty");
  }
  const double own = from_log.stated || s.reliability < 1 ? s.reliability : fan ? 1.0 : 0.9;
  const bool revised = !o.revision.empty() && !fan;  // in place of a fixed discount
  s.reliability = o.reliability.value_or(revised ? 1.0 : own);
  if (o.contextual.size() == 2) s.reliability_if_empty = o.contextual[0], s.reliability_if_occupied = o.contextual[1];
  apply_dependence(o.dependence, s);
  if (const auto errors = check(s); !errors.empty()) throw InputError(listed(errors));
  return s;
}

bool holds_both_kinds(const Log& log) {
  const auto fan = [](const LogSensor& s) { return s.sensor.model == Model::beam; };
  return std::any_of(log.sensors.begin(), log.sensors.end(), fan) &&
         !std::all_of(log.sensors.begin(), log.sensors.end(), fan);
}

Fused fuse(const Log& log, const MappingOptions& options, Plan plan, const JournalFile& file) {
  if (!options.cell_m && !log.fans()) plan.params.cell_m = 0.1;
  std::vector<Sensor> sensors;
  const bool mixed = holds_both_kinds(log);
  std::vector<Revision> revisions;
  if (!options.revision.empty()) revisions = read_revisions(options.revision);
  for (const LogSensor& s : log.sensors) {
    sensors.push_back(configured(s, options, mixed));
    apply_revision(revisions, options.revision, sensors.size() - 1, sensors.back());
  }

  Fused out{Map(plan.params, plan.executor), {}, 0, {}, plan.executor};
  page_to(out.map, options.page_dir);
  std::vector<SensorId> ids;
  for (const Sensor& sensor : sensors) {
    try {
      ids.push_back(out.map.add(sensor));
    } catch (const std::invalid_argument& bad) {  // what only map and sensor together can tell: the reach in cells
      throw InputError(bad.what());
    }
    const std::string model(name(sensor.model));
    if (std::find(out.models.begin(), out.models.end(), model) == out.models.end()) out.models.push_back(model);
  }
  if (!options.params_of_other_models) require_used(parse_settings(options.params), out.models);
  std::vector<Reading> readings;
  readings.reserve(log.readings.size());
  for (const LogReading& r : log.readings) {
    readings.push_back({ids[r.sensor], std::span(log.ranges_m).subspan(r.first, r.count)});
  }
  std::vector<Scan> scans;
  scans.reserve(log.scans.size());
  for (const LogScan& s : log.scans) {
    scans.push_back({s.stamp_ns, s.T_map_robot, std::span<const Reading>(readings).subspan(s.first, s.count)});
  }
  MapJournal journal(file, out.map, scans);
  Progress progress("fusing");
  for (std::size_t at = 0; at < scans.size(); at += kBatch) {
    const auto batch = std::span<const Scan>(scans).subspan(at, std::min(kBatch, scans.size() - at));
    journal.record(at, batch);
    const auto start = Clock::now();
    try {
      out.report += integrate_what_fits(out.map, batch, !options.page_dir.empty());
    } catch (const std::length_error& full) {
      throw InputError(fmt::format("the map grows beyond its memory cap: {}; {}", full.what(), kMoreRoom));
    } catch (const std::system_error& disk) {
      throw InputError(fmt::format("--page-dir: {}", disk.what()));
    }
    out.fusion_s += seconds_since(start);
    progress.show(at + batch.size(), scans.size());
  }
  out.journal = journal.facts();
  return out;
}

}  // namespace evigrid::driver
