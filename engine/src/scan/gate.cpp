// SPDX-License-Identifier: Apache-2.0
#include "scan/gate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model_rows.hpp"
#include "scan/false_reflection.hpp"

namespace evigrid {

kernels::ConeSpec cone_spec(const Sensor& s, double cell_m) {
  kernels::ConeSpec spec{model_row(s.model).cone,
                         cell_m,
                         s.aperture_rad,
                         s.min_range_m,
                         s.max_range_m,
                         s.reliability,
                         s.hughes.r_max_m,
                         s.hughes.max_occupied,
                         s.hughes.tolerance_m,
                         s.li.rho_e,
                         s.li.rho_o,
                         s.li.rho_c,
                         s.li.rho_i,
                         s.li.epsilon_ratio,
                         s.reliability_if_empty,
                         s.reliability_if_occupied};
  spec.li2006_rho_v = s.li2006.rho_v;
  spec.li2006_epsilon_m = s.li2006.epsilon_m;
  spec.discount_by_lambda = s.li2006.discount_by_lambda;
  spec.moravec_epsilon_m = s.moravec.epsilon_m;
  switch (s.model) {  // these three share their constants
    case Model::probability:
      spec.width_m = s.probability.epsilon_m, spec.rho_v_m = s.probability.rho_v_m;
      break;
    case Model::fuzzy:
      spec.width_m = s.fuzzy.epsilon_m, spec.rho_v_m = s.fuzzy.rho_v_m, spec.as_printed = s.fuzzy.as_printed;
      spec.k_empty = s.fuzzy.k_empty, spec.k_occupied = s.fuzzy.k_occupied;
      break;
    default:
      spec.width_m = s.oriolo.delta_m, spec.rho_v_m = s.oriolo.rho_v_m;
      spec.k_empty = s.oriolo.k_empty, spec.k_occupied = s.oriolo.k_occupied;
  }
  return spec;
}

kernels::FanSpec fan_spec(const Sensor& s, double cell_m) {
  return {cell_m,
          s.min_range_m,
          s.max_range_m,
          s.reliability,
          s.beams,
          s.first_beam_rad,
          s.beam_step_rad,
          s.beam.empty,
          s.beam.occupied,
          s.beam.empty_margin_m,
          s.beam.occupied_half_width_m,
          s.reliability_if_empty,
          s.reliability_if_occupied};
}

CompiledSensor::CompiledSensor(const Sensor& s, double cell_m)
    : sensor(s),
      type(s.model == Model::beam ? decltype(type)(kernels::FanType(fan_spec(s, cell_m)))
                                  : decltype(type)(kernels::ConeType(cone_spec(s, cell_m)))) {}

namespace {

/// Why a range cannot be used; nullopt when it can. REP 117 for what is not finite.
std::optional<Refusal> refuse(const Sensor& s, float range) {
  if (std::isnan(range)) return Refusal::not_a_number;
  if (range >= s.no_return_m) return Refusal::no_return;  // +inf as well
  if (std::isinf(range)) return Refusal::too_close;
  if (range < 0) return Refusal::negative;
  if (range < s.min_range_m || range == 0) return Refusal::too_close;
  if (s.model != Model::beam && range > s.max_range_m) return Refusal::above_max_range;
  return std::nullopt;
}

bool usable(const Pose2& p, double cell_m) {
  // Beyond 2^50 cells a double no longer resolves the lattice.
  const double most = 1125899906842624.0 * cell_m;
  return std::fabs(p.x_m) < most && std::fabs(p.y_m) < most && std::fabs(p.yaw_rad) < 1e5;
}

void count(Report& r, Refusal why, std::uint64_t n = 1) { r.refused[static_cast<std::size_t>(why)] += n; }

void gate_fan(const Reading& reading, const CompiledSensor& c, const kernels::SensorPose& pose, std::int64_t stamp_ns,
              std::vector<Footprint>& out, Report& report) {
  const Sensor& s = c.sensor;
  auto fan = std::make_unique<kernels::Fan>();
  std::vector<float>& ranges = fan->range;
  ranges.assign(reading.ranges_m.begin(), reading.ranges_m.end());
  bool any = false;
  for (float& r : ranges) {
    const auto why = refuse(s, r);
    if (why && !(*why == Refusal::no_return && s.clear_no_return)) {
      count(report, *why);
      r = -1;
      continue;
    }
    ++report.readings_used;
    any = true;
    if (why || r > s.max_range_m) {
      ++report.readings_clipped;
      r = static_cast<float>(2 * s.max_range_m);  // anything beyond the limit clears up to it
    }
  }
  if (!any) return;
  Footprint f;
  f.sensor = &c;
  f.pose = pose;
  f.stamp_ns = stamp_ns;
  f.fan = std::move(fan);
  out.push_back(std::move(f));
}

/// What the filter compares: the range of each reading of a cone, NaN where the gate would refuse it anyway.
std::vector<RingReading> ring_of(const Scan& scan, const std::vector<CompiledSensor>& sensors) {
  std::vector<RingReading> ring;
  for (std::size_t i = 0; i < scan.readings.size(); ++i) {
    const Reading& r = scan.readings[i];
    if (r.sensor >= sensors.size() || r.ranges_m.size() != 1) continue;
    const Sensor& s = sensors[r.sensor].sensor;
    if (s.model == Model::beam) continue;
    const float range = r.ranges_m[0];
    ring.push_back({i, s.T_robot_sensor.yaw_rad, refuse(s, range) ? std::nanf("") : range});
  }
  return ring;
}

}  // namespace

void gate_scan(const Scan& scan, const std::vector<CompiledSensor>& sensors, const MapParams& params,
               std::vector<Footprint>& out, Report& report) {
  const double cell_m = params.cell_m;
  std::vector<std::size_t> dropped;
  if (params.false_reflection_m >= 0) dropped = false_reflections(ring_of(scan, sensors), params.false_reflection_m);
  for (const Reading& reading : scan.readings) {
    if (reading.sensor >= sensors.size()) {
      count(report, Refusal::unknown_sensor);
      continue;
    }
    const CompiledSensor& c = sensors[reading.sensor];
    const Sensor& s = c.sensor;
    if (reading.ranges_m.size() != static_cast<std::size_t>(s.beams)) {
      count(report, Refusal::wrong_beam_count);
      continue;
    }
    if (!usable(scan.T_map_robot, cell_m)) {
      count(report, Refusal::pose_not_finite, reading.ranges_m.size());
      continue;
    }
    const Pose2 p = compose(scan.T_map_robot, s.T_robot_sensor);
    const kernels::SensorPose pose{p.x_m, p.y_m, p.yaw_rad};
    if (s.model == Model::beam) {
      gate_fan(reading, c, pose, scan.stamp_ns, out, report);
      continue;
    }
    const float range = reading.ranges_m[0];
    if (const auto why = refuse(s, range)) {
      count(report, *why);
      continue;
    }
    if (std::binary_search(dropped.begin(), dropped.end(), static_cast<std::size_t>(&reading - scan.readings.data()))) {
      count(report, Refusal::false_reflection);
      continue;
    }
    ++report.readings_used;
    Footprint f;
    f.sensor = &c;
    f.pose = pose;
    f.stamp_ns = scan.stamp_ns;
    f.range_m = range;
    f.cone_model = std::get<kernels::ConeType>(c.type).spec.model;
    out.push_back(std::move(f));
  }
}

void compile(Footprint& f, const kernels::KernelTable& table) {
  if (f.fan) {
    table.compile_fan(std::get<kernels::FanType>(f.sensor->type), f.pose, *f.fan);
  } else {
    f.cone = kernels::compile_cone(std::get<kernels::ConeType>(f.sensor->type), f.pose, f.range_m);
  }
}

std::uint64_t Report::refused_total() const noexcept {
  std::uint64_t n = 0;
  for (const auto r : refused) n += r;
  return n;
}

Report& Report::operator+=(const Report& b) noexcept {
  readings_used += b.readings_used;
  for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += b.refused[i];
  readings_clipped += b.readings_clipped;
  stamps_backwards += b.stamps_backwards;
  cells_updated += b.cells_updated;
  total_conflicts += b.total_conflicts;
  max_conflict = max_conflict > b.max_conflict ? max_conflict : b.max_conflict;
  if (touched.empty()) {
    touched = b.touched;
  } else if (!b.touched.empty()) {
    const std::int64_t x1 = std::max(touched.x + touched.width, b.touched.x + b.touched.width);
    const std::int64_t y1 = std::max(touched.y + touched.height, b.touched.y + b.touched.height);
    touched.x = std::min(touched.x, b.touched.x);
    touched.y = std::min(touched.y, b.touched.y);
    touched.width = x1 - touched.x;
    touched.height = y1 - touched.y;
  }
  return *this;
}

}  // namespace evigrid
