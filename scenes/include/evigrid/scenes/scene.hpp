// SPDX-License-Identifier: Apache-2.0
// A simulated run as plain data: map, world, robot, trajectory, read from a TOML file. Metres, radians, seconds; the
// file speaks degrees. Names of rules and models stay text: only the engine knows which exist.
#pragma once
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/raycast/noise.hpp"
#include "evigrid/raycast/world.hpp"

namespace evigrid::scenes {

/// x axis forward, y axis left. T_map_robot takes robot coordinates to map coordinates.
struct Pose {
  double x_m = 0, y_m = 0, yaw_rad = 0;
};

/// a ∘ b, as in T_map_sensor = compose(T_map_robot, T_robot_sensor).
[[nodiscard]] Pose compose(const Pose& a, const Pose& b) noexcept;

struct MapSpec {
  double cell_m = 0.05;
  std::string rule;
};

struct SonarSpec {
  Pose T_robot_sensor;      ///< the cone looks along its x axis
  std::string model;        ///< name of the inverse sensor model
  double aperture_rad = 0;  ///< full opening
  double min_range_m = 0, max_range_m = 0;
  double reliability = 1;     ///< in (0, 1]
  raycast::RangeNoise noise;  ///< of the simulated readings
};

/// Waypoints, driven one after the other: turn on the spot towards the next one, then straight to it.
struct TrajectorySpec {
  std::vector<raycast::Point> waypoints;  ///< at least one; the first one is the start
  double speed_m_s = 0.5;
  double turn_rate_rad_s = 1;
  double period_s = 0.1;  ///< one scan of all sonars per period
  std::uint64_t seed = 0;
};

struct Scene {
  std::string name;
  MapSpec map;
  raycast::World world;
  std::vector<SonarSpec> sonars;  ///< a ring is expanded; index = sensor number
  TrajectorySpec trajectory;
};

/// A scene that cannot be used. what() is `file:line: field: message`, or `file: message` when the file cannot be read.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws SceneError.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path);

/// Same for text; `name` stands for the file name in messages. Throws SceneError.
[[nodiscard]] Scene parse_scene(std::string_view text, std::string_view name);

/// The embedded scene: a furnished room of about 10 × 10 m and a robot with a ring of 24 sonars. TOML text.
[[nodiscard]] std::string_view default_scene_text() noexcept;

}  // namespace evigrid::scenes
