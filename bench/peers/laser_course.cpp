// SPDX-License-Identifier: Apache-2.0
// Logs and generated buildings as one kind of input, and maps laid over each other.
#include "bench/peers/laser_course.hpp"

#include <algorithm>
#include <cmath>

#include "log/readers.hpp"
#include "world_input.hpp"

namespace evigrid::bench {
namespace {

LaserCourse from_log(const driver::Log& log, std::string name, double max_range_m, std::size_t stride) {
  LaserCourse c{std::move(name), log.sensors.front().sensor, {}, {}, {}};
  c.fan.max_range_m = std::min(max_range_m, c.fan.no_return_m);
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
  for (std::size_t i = 0; i < log.scans.size(); i += stride) {
    const driver::LogReading& r = log.readings[log.scans[i].first];
    if (r.sensor != 0) continue;  // of a second fan
    const Pose2 p = log.scans[i].T_map_robot;
    if (c.poses.empty()) low_x = high_x = p.x_m, low_y = high_y = p.y_m;
    low_x = std::min(low_x, p.x_m), high_x = std::max(high_x, p.x_m);
    low_y = std::min(low_y, p.y_m), high_y = std::max(high_y, p.y_m);
    c.poses.push_back(p);
    c.ranges_m.insert(c.ranges_m.end(), log.ranges_m.begin() + static_cast<std::ptrdiff_t>(r.first),
                      log.ranges_m.begin() + static_cast<std::ptrdiff_t>(r.first + r.count));
  }
  float farthest = 0;
  for (const float r : c.ranges_m) {
    if (c.used(r)) farthest = std::max(farthest, r);
  }
  const double reach = std::min(c.fan.max_range_m, static_cast<double>(farthest)) + 2;
  const auto cell = [](double m) { return static_cast<std::int64_t>(std::floor(m / kCell_m)); };
  c.box = {cell(low_x - reach), cell(low_y - reach), cell(high_x + reach) - cell(low_x - reach),
           cell(high_y + reach) - cell(low_y - reach)};
  return c;
}

}  // namespace

LaserCourse recorded(const std::string& path, double max_range_m, std::size_t stride) {
  return from_log(driver::read_log({path}, "carmen"), path, max_range_m, stride);
}

LaserCourse generated(std::uint64_t seed, std::size_t stride) {
  driver::WorldOptions world;
  world.world = "building";
  world.robot = "laser180";
  world.seed = static_cast<std::int64_t>(seed);
  const driver::Simulated run = driver::simulate(driver::open_input(world).scene);
  return from_log(run.log, "building of seed " + std::to_string(seed), run.log.sensors.front().sensor.max_range_m,
                  stride);
}

Agreement agreement(const Map& map, const LaserPeer& peer, CellRect box) {
  double free_both = 0, free_any = 0, occupied_both = 0, occupied_any = 0, known = 0, ours_unknown = 0,
         peer_unknown = 0;
  for (std::int64_t y = box.y; y < box.y + box.height; ++y) {
    for (std::int64_t x = box.x; x < box.x + box.width; ++x) {
      const Mass m = map.mass({x, y});
      const Seen a = seen(static_cast<double>(m.o) + 0.5 * static_cast<double>(m.u)), b = peer.at({x, y});
      free_both += a == Seen::free && b == Seen::free;
      free_any += a == Seen::free || b == Seen::free;
      occupied_both += a == Seen::occupied && b == Seen::occupied;
      occupied_any += a == Seen::occupied || b == Seen::occupied;
      if (a == Seen::unknown && b == Seen::unknown) continue;
      ++known;
      ours_unknown += a == Seen::unknown;
      peer_unknown += b == Seen::unknown;
    }
  }
  return {free_both / free_any, occupied_both / occupied_any, ours_unknown / known, peer_unknown / known};
}

}  // namespace evigrid::bench
