// SPDX-License-Identifier: Apache-2.0
#include "tests/oracle/reference_map.hpp"

#include <cmath>

#include "evigrid/revision.hpp"
#include "tests/oracle/set_rules.hpp"

namespace oracle {
namespace {

using evigrid::Model;
using evigrid::Pose2;
using evigrid::Refusal;
using evigrid::Sensor;

constexpr double kLeastMass = 1e-12, kLeastUnknown = 1e-30, kTotalConflictBelow = 1e-12;

bool finite(const Pose2& p) { return std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.yaw_rad); }

/// d < limit for a distance known by its square; both exact.
bool nearer(double d_squared, double limit) { return limit > 0 && d_squared < limit * limit; }

double square(double t) { return t * t; }

/// Li et al. 2014: logistic neurons, the bias last in each row.
Source revised(const evigrid::RevisionNetwork& network, const Source& s) {
  const double in[] = {s.x, s.y, s.v, s.z};
  const double* w = network.weight.data();
  const auto neuron = [&w](const double* input, int count) {
    double t = 0;
    for (int i = 0; i < count; ++i) t += *w++ * input[i];
    return 1 / (1 + std::exp(-(t + *w++)));
  };
  double hidden[5], out[4], sum = 0;
  for (double& h : hidden) h = neuron(in, 4);
  for (double& o : out) sum += o = neuron(hidden, 5);
  Source r;
  r.x = out[0] / sum, r.y = out[1] / sum, r.v = out[2] / sum, r.z = out[3] / sum;
  return r;
}

}  // namespace

evigrid::SensorId ReferenceMap::add(const Sensor& sensor) {
  sensors_.push_back({sensor, Lattice(reach_cells(sensor, params_.cell_m))});
  return static_cast<evigrid::SensorId>(sensors_.size() - 1);
}

void ReferenceMap::integrate(const evigrid::Scan& scan) {
  const auto refuse = [this](Refusal why, std::uint64_t n = 1) { report_.refused[static_cast<std::size_t>(why)] += n; };
  if (scan.stamp_ns < last_stamp_ns_) ++report_.stamps_backwards;
  stamp_ns_ = scan.stamp_ns;
  last_stamp_ns_ = params_.decay_s > 0 ? std::max(last_stamp_ns_, scan.stamp_ns) : scan.stamp_ns;
  for (const evigrid::Reading& reading : scan.readings) {
    if (!finite(scan.T_map_robot)) {
      refuse(Refusal::pose_not_finite, reading.ranges_m.size());
      continue;
    }
    if (reading.sensor >= sensors_.size()) {
      refuse(Refusal::unknown_sensor);
      continue;
    }
    const Declared& declared = sensors_[reading.sensor];
    if (reading.ranges_m.size() != static_cast<std::size_t>(declared.sensor.beams)) {
      refuse(Refusal::wrong_beam_count);
      continue;
    }
    const Pose2 pose = evigrid::compose(scan.T_map_robot, declared.sensor.T_robot_sensor);
    if (declared.sensor.model == Model::beam) {
      fan(declared, pose, reading.ranges_m);
    } else {
      cone(declared, pose, reading.ranges_m[0]);
    }
  }
  end_scan();
}

ReferenceMap::Gate ReferenceMap::gate(const Sensor& sensor, float range_m) {
  const bool is_fan = sensor.model == Model::beam;
  const double range = range_m;
  Refusal why{};
  if (std::isnan(range)) {
    why = Refusal::not_a_number;
  } else if (std::isinf(range) && range < 0) {
    why = Refusal::too_close;
  } else if (range < 0) {
    why = Refusal::negative;
  } else if (range < sensor.min_range_m) {
    why = Refusal::too_close;
  } else if (std::isinf(range) || range >= sensor.no_return_m) {
    if (is_fan && sensor.clear_no_return) {
      ++report_.readings_used, ++report_.readings_clipped;
      return Gate::clip;
    }
    why = Refusal::no_return;
  } else if (range > sensor.max_range_m) {
    if (is_fan) {
      ++report_.readings_used, ++report_.readings_clipped;
      return Gate::clip;
    }
    why = Refusal::above_max_range;
  } else {
    ++report_.readings_used;
    return Gate::use;
  }
  ++report_.refused[static_cast<std::size_t>(why)];
  return Gate::refuse;
}

void ReferenceMap::cone(const Declared& declared, const Pose2& pose, float range_m) {
  const auto& sensor = declared.sensor;
  const auto& lattice = declared.lattice;
  if (gate(sensor, range_m) != Gate::use) return;
  const double cell = params_.cell_m;
  const Direction left = edge_direction(pose.yaw_rad + sensor.aperture_rad / 2);
  const Direction right = edge_direction(pose.yaw_rad - sensor.aperture_rad / 2);
  const double range = lattice.round(range_m / cell);  // cells, as the next three
  const double nearest = std::max(lattice.round(sensor.min_range_m / cell), lattice.step());
  double farthest = 0, occupied_from = 0, width = lattice.round(arc_m(sensor) / cell);
  if (sensor.model != Model::li2006) width = std::max(width, lattice.step());
  if (sensor.model == Model::hughes1992) {
    const double tolerance = lattice.round(sensor.hughes.tolerance_m / cell);
    farthest = std::min(range + tolerance, lattice.round(sensor.hughes.r_max_m / cell));
    occupied_from = range - tolerance;
  } else if (sensor.model == Model::li2014) {
    farthest = lattice.round(range * (1 + 2 * sensor.li.epsilon_ratio));
  } else {
    farthest = range + width;
    const double rho_v_m = sensor.model == Model::oriolo1997    ? sensor.oriolo.rho_v_m
                           : sensor.model == Model::probability ? sensor.probability.rho_v_m
                           : sensor.model == Model::fuzzy       ? sensor.fuzzy.rho_v_m
                                                                : 1e9;
    farthest = std::min(farthest, lattice.round(std::min(rho_v_m + 5, 1e6) / cell));
  }
  sweep(declared, pose, farthest, [&](double dx, double dy, double d_squared, Source& source) {
    if (d_squared < square(nearest) || d_squared > square(farthest)) return false;
    const double beside_left = cross(dx, dy, left.x, left.y), beside_right = cross(right.x, right.y, dx, dy);
    if (beside_left < 0 || beside_right < 0) return false;
    const EdgeAngles angles{std::atan2(beside_left, dx * left.x + dy * left.y),
                            std::atan2(beside_right, dx * right.x + dy * right.y)};
    const Zone zone = nearer(d_squared, occupied_from) ? Zone::empty : Zone::occupied;
    source = cone_model(sensor, {std::sqrt(d_squared), range, width, nearest, cell}, angles, zone);
    return true;
  });
}

void ReferenceMap::fan(const Declared& declared, const Pose2& pose, std::span<const float> ranges_m) {
  const auto& sensor = declared.sensor;
  const auto& lattice = declared.lattice;
  const double cell = params_.cell_m;
  const int beams = sensor.beams;
  const double farthest = lattice.round(sensor.max_range_m / cell);
  const double nearest = std::max(lattice.round(sensor.min_range_m / cell), lattice.step());
  const double margin = lattice.round(sensor.beam.empty_margin_m / cell);
  const double half_width = lattice.round(sensor.beam.occupied_half_width_m / cell);
  std::vector<Direction> border;
  for (int k = 0; k <= beams; ++k)
    border.push_back(direction(pose.yaw_rad + sensor.first_beam_rad + (k - 0.5) * sensor.beam_step_rad));
  std::vector<Gate> gates;
  std::vector<double> range;
  double radius = 0;
  for (float r : ranges_m) {
    gates.push_back(gate(sensor, r));
    range.push_back(gates.back() == Gate::use ? lattice.round(r / cell) : 0);
    if (gates.back() == Gate::clip) radius = farthest;
    if (gates.back() == Gate::use) radius = std::max(radius, std::min(range.back() + half_width, farthest));
  }
  const auto holds = [&](int i, double dx, double dy) {
    if (i < 0 || i >= beams) return false;
    const double after = cross(border[i].x, border[i].y, dx, dy);
    return (after > 0 || (i == 0 && after == 0)) && cross(dx, dy, border[i + 1].x, border[i + 1].y) >= 0;
  };
  const double full_turn = 2 * std::numbers::pi / sensor.beam_step_rad;  // in beams
  sweep(declared, pose, radius, [&](double dx, double dy, double d_squared, Source& source) {
    if (d_squared < square(nearest) || d_squared > square(farthest)) return false;
    // The angle only proposes beams; the crosses decide. Beam 0 goes first: on a full turn its border is also the last.
    const double bearing = std::atan2(dy, dx) - pose.yaw_rad - sensor.first_beam_rad;
    double guess = std::fmod(std::round(bearing / sensor.beam_step_rad), full_turn);
    if (guess < -1) guess += full_turn;
    const int middle = static_cast<int>(guess);
    int index = holds(0, dx, dy) ? 0 : -1;
    for (int i = middle - 2; i <= middle + 2 && index < 0; ++i)
      if (holds(i, dx, dy)) index = i;
    if (index < 0 && holds(beams - 1, dx, dy)) index = beams - 1;
    if (index < 0 || gates[index] == Gate::refuse) return false;
    Zone zone = Zone::none;
    if (gates[index] == Gate::clip) {
      zone = nearer(d_squared, farthest) ? Zone::empty : Zone::none;
    } else if (nearer(d_squared, range[index] - margin)) {
      zone = Zone::empty;
    } else if (!nearer(d_squared, range[index] - half_width) && d_squared <= square(range[index] + half_width)) {
      zone = Zone::occupied;
    }
    if (zone == Zone::none) return false;
    source = beam(sensor, std::sqrt(d_squared) * cell, zone);
    return true;
  });
}

void ReferenceMap::sweep(const Declared& declared, const Pose2& pose, double radius_cells, const Say& say) {
  const ApexCoordinate x = apex_coordinate(declared.lattice, pose.x_m, params_.cell_m);
  const ApexCoordinate y = apex_coordinate(declared.lattice, pose.y_m, params_.cell_m);
  const auto reach = static_cast<std::int64_t>(std::ceil(radius_cells)) + 1;
  const double disc = square(radius_cells);
  for (std::int64_t j = -reach; j <= reach; ++j)
    for (std::int64_t i = -reach; i <= reach; ++i) {
      const double dx = static_cast<double>(i) - x.offset, dy = static_cast<double>(j) - y.offset;
      const double d_squared = dx * dx + dy * dy;
      Source source;
      if (d_squared > disc || !say(dx, dy, d_squared, source)) continue;
      const evigrid::CellIndex at{x.cell + i, y.cell + j};
      const Sensor& s = declared.sensor;
      source = discount(contextual(source, s.reliability_if_empty, s.reliability_if_occupied), s.reliability);
      if (s.revision && source.x + source.y + source.z > 0) source = without_paradox(revised(*s.revision, source));
      if (s.dependence != evigrid::Dependence::independent) {
        hear(at, source, s);
      } else {
        update(cells_[at], source, s);
      }
    }
}

/// What the rule makes of a source where nothing is known, without what that leaves on empty ∩ occupied.
Source ReferenceMap::without_paradox(const Source& source) const {
  Belief<double, 3> nothing{}, said{};
  nothing[kUnknown] = 1;
  said[kEmpty] = source.x, said[kOccupied] = source.y, said[kUnknown] = source.v, said[kBoth] = source.z;
  const auto m = combine<double, 3>(params_.rule, cell_frame(), nothing, said, kTotalConflictBelow).m;
  const double sum = m[kEmpty] + m[kOccupied] + m[kUnknown];
  Source alone;
  alone.x = m[kEmpty] / sum, alone.y = m[kOccupied] / sum, alone.v = m[kUnknown] / sum;
  return alone;
}

/// What the reading says by itself; several of one scan become one source when it ends.
void ReferenceMap::hear(const evigrid::CellIndex& at, const Source& source, const Sensor& sensor) {
  ++report_.cells_updated;
  const Source alone = without_paradox(source);
  if (alone.x == 0 && alone.y == 0) return;
  heard_[static_cast<std::size_t>(sensor.dependence)][at].push_back({alone, sensor.weight_exponent});
}

/// Policies by their definition: w = v/(v + x) is the weight of a simple support; cautious takes the least w of each
/// hypothesis, weighted the product of w^γ; the two supports are then combined by Dempster's rule.
void ReferenceMap::end_scan() {
  using evigrid::Dependence;
  constexpr double kLeastWeighable = 1e-4;
  for (const Dependence policy : {Dependence::cautious, Dependence::once_per_scan, Dependence::weighted}) {
    auto& all = heard_[static_cast<std::size_t>(policy)];
    for (const auto& [at, said] : all) {
      Source together = said.front().source;
      if (policy == Dependence::weighted || (policy == Dependence::cautious && said.size() > 1)) {
        double w1 = 1, w2 = 1;
        for (const Heard& h : said) {
          const double v = std::max(h.source.v, kLeastWeighable);
          const double a = v / (v + h.source.x), b = v / (v + h.source.y);
          w1 = policy == Dependence::cautious ? std::min(w1, a) : w1 * std::pow(a, h.exponent);
          w2 = policy == Dependence::cautious ? std::min(w2, b) : w2 * std::pow(b, h.exponent);
        }
        const double sum = w1 + w2 - w1 * w2;
        together.x = (1 - w1) * w2 / sum, together.y = (1 - w2) * w1 / sum, together.v = w1 * w2 / sum;
      }
      const auto counted = report_.cells_updated;  // each reading was
      update(cells_[at], together, {});
      report_.cells_updated = counted;
    }
    all.clear();
  }
}

void ReferenceMap::forget(ReferenceCell& cell, std::int64_t now_ns) const {
  if (params_.decay_s <= 0 || cell.updates == 0 || now_ns <= cell.stamp_ns) return;
  const double share = std::exp(-static_cast<double>(now_ns - cell.stamp_ns) / (1e9 * cell.tau_s));
  cell.u = 1 - share + share * cell.u;
  for (double* m : {&cell.e, &cell.o, &cell.c}) *m = share * *m < kLeastMass ? 0 : share * *m;
  for (std::size_t set : {kEmpty, kOccupied, kBoth}) cell.state.m[set] *= share;  // conjunctive, dsmc
  cell.state.m[kUnknown] = 1 - share + share * cell.state.m[kUnknown];
}

ReferenceCell ReferenceMap::now(const ReferenceCell& cell) const {
  ReferenceCell out = cell;
  forget(out, last_stamp_ns_);
  return out;
}

void ReferenceMap::update(ReferenceCell& cell, const Source& source, const evigrid::Sensor& sensor) {
  forget(cell, stamp_ns_);
  if (params_.decay_s > 0) {
    cell.stamp_ns = cell.updates == 0 ? stamp_ns_ : std::max(cell.stamp_ns, stamp_ns_);
    cell.tau_s = sensor.decay_s > 0 ? sensor.decay_s : params_.decay_s;
  }
  const auto count = [&](double conflict, bool total) {
    cell.conflict += conflict;
    cell.con -= std::log(std::max(1 - conflict, 1e-12));
    cell.last = conflict;
    ++cell.updates;
    ++report_.cells_updated;
    report_.total_conflicts += total;
    report_.max_conflict = std::max(report_.max_conflict, conflict);
  };
  if (const auto answer = update_state(params_, cell.state, source)) {
    cell.e = answer->e, cell.o = answer->o, cell.u = answer->u, cell.c = answer->c;
    return count(answer->conflict, false);
  }
  Belief<double, 3> state{}, said{};
  state[kEmpty] = cell.e, state[kOccupied] = cell.o, state[kUnknown] = cell.u;
  said[kEmpty] = source.x, said[kOccupied] = source.y, said[kUnknown] = source.v, said[kBoth] = source.z;
  const auto fused = combine<double, 3>(params_.rule, cell_frame(), state, said, kTotalConflictBelow);
  cell.e = fused.m[kEmpty] < kLeastMass ? 0 : fused.m[kEmpty];
  cell.o = fused.m[kOccupied] < kLeastMass ? 0 : fused.m[kOccupied];
  cell.u = std::max(fused.m[kUnknown], kLeastUnknown);
  count(fused.conflict, fused.total_conflict);
}

}  // namespace oracle
