// SPDX-License-Identifier: Apache-2.0
#include "score/flips.hpp"

namespace evigrid::driver {

int readings_to_flip(const MapParams& params, int agreeing) {
  constexpr double kSaid = 0.6, kMax_m = 100, kCell_m = 0.05, kAt_m = 1.025;  // the centre of a cell
  constexpr float kTie = 1e-5F;                                               // equal but for rounding
  MapParams p = params;
  p.cell_m = kCell_m;
  p.decay_s = 0;
  Map map(p, make_serial_executor());
  Sensor s;
  s.model = Model::beam;
  s.max_range_m = kMax_m;
  s.beams = 1;
  s.beam_step_rad = 0.01;
  const double fall = 1 - kAt_m / (2 * kMax_m);  // of the model, at that distance
  s.beam.empty = kSaid / fall;
  s.beam.occupied = kSaid / fall;
  const SensorId id = map.add(s);
  const CellIndex cell = map.cell_at(kAt_m, 0);
  std::int64_t stamp_ns = 0;
  const auto say = [&](double range) {
    const auto range_m = static_cast<float>(range);
    const Reading reading{id, {&range_m, 1}};
    map.integrate({.stamp_ns = stamp_ns++, .T_map_robot = {0, kCell_m / 2, 0}, .readings = {&reading, 1}});
  };
  for (int i = 0; i < agreeing; ++i) say(3);
  int flips = 0;
  for (; flips < kMostFlips; ++flips) {
    const Mass m = map.mass(cell);
    if (m.o > m.e + kTie) break;
    say(kAt_m);
  }
  return flips;
}

}  // namespace evigrid::driver
