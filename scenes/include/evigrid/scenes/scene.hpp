// SPDX-License-Identifier: Apache-2.0
// A simulated run as plain data: map, world, robot, trajectory, read from a TOML file. Metres, radians, seconds; the
// file speaks degrees. Names of rules and models stay text: only the engine knows which exist.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/raycast/noise.hpp"
#include "evigrid/raycast/world.hpp"
#include "evigrid/scenes/tour.hpp"

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
  double decay_s = 0;              ///< τ of forgetting, s; 0: nothing is forgotten
  double false_reflection_m = -1;  ///< tolerance of the filter of false reflections; below 0: none
};

/// Parameters by name, of each model that the scene gives some for.
using ModelParameters = std::map<std::string, std::map<std::string, double>>;

struct SonarSpec {
  Pose T_robot_sensor;  ///< the cone looks along its x axis
  std::string model;    ///< name of the inverse sensor model
  ModelParameters parameters;
  double aperture_rad = 0;  ///< full opening
  double min_range_m = 0, max_range_m = 0;
  double reliability = 1;     ///< in (0, 1]
  double decay_s = 0;         ///< τ of what it says, s, in maps that forget; 0: the map's
  std::string dependence;     ///< name of what readings of one scan are to one another; empty: independent
  double weight_exponent = 1;
  raycast::RangeNoise noise;  ///< of the simulated readings
  int group = 0;              ///< sonars of one group ping at the same moment: cross-talk happens within it
};

/// A laser scanner: beam i looks to first_rad + i·step_rad in its own frame.
struct LaserSpec {
  Pose T_robot_sensor;
  std::string model = "beam";
  ModelParameters parameters;
  double first_rad = 0, step_rad = 0;
  int beams = 0;
  double min_range_m = 0, max_range_m = 0;
  double reliability = 1;
  double decay_s = 0;
  std::string dependence;
  double weight_exponent = 1;
  raycast::RangeNoise noise;
};

/// What the simulated sonars suffer from beside noise.
struct EchoSpec {
  bool second_bounce = false;  ///< too long readings by way of a specular surface
  bool cross_talk = false;     ///< within a firing group
};

/// A stretch with constant speed and turn rate: a straight line, an arc of an exact circle, or a turn on the spot.
struct Motion {
  double duration_s = 0, speed_m_s = 0, turn_rate_rad_s = 0;
};

/// How something drives. Waypoints are driven one after the other: turn on the spot towards the next one, then straight
/// to it. Or legs of constant velocity, from `start` on.
struct TrajectorySpec {
  std::vector<raycast::Point> waypoints;  ///< the first one is the start, unless `start` is given
  double speed_m_s = 0.5;
  double turn_rate_rad_s = 1;
  double period_s = 0.1;  ///< one scan of all sensors per period
  std::uint64_t seed = 0;
  std::vector<Motion> legs{};   ///< instead of waypoints; needs a start
  std::optional<Pose> start{};  ///< absent: at the first waypoint, facing the next one
};

/// Wheel odometry of a differential drive: what the robot believes to have driven. Each wheel's way is scaled by its
/// drift and by noise; standard deviations grow with the root of the way. Counter-based, repeatable from the seed.
struct OdometrySpec {
  bool used = false;                       ///< a drift or a noise is stated; else the robot knows its true pose
  double track_m = 0.3;                    ///< distance of the wheels
  double drift_left = 0, drift_right = 0;  ///< relative error of each wheel's way, constant over the run
  double noise_m_per_sqrt_m = 0;           ///< standard deviation of each wheel's way over one metre
};

/// Something that moves while the robot measures: a shape in its own frame, driven along waypoints of its own.
struct MoverSpec {
  std::string name;
  raycast::World shape;
  TrajectorySpec trajectory;  ///< period and seed are the robot's
  bool loop = false;          ///< starts again at the end, where it should have come back to; else it stays there
};

struct Scene {
  std::string name;
  MapSpec map;
  raycast::World world;
  std::vector<MoverSpec> movers;
  double radius_m = 0.2;          ///< of the robot
  std::vector<SonarSpec> sonars;  ///< a ring is expanded; index = sensor number
  std::vector<LaserSpec> lasers;  ///< numbered after the sonars
  EchoSpec echo;
  OdometrySpec odometry;
  TrajectorySpec trajectory;
};

/// A scene that cannot be used. what() is `file:line: field: message`, or `file: message` when the file cannot be read.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What reading may cost, beyond the text itself: a few words can ask for a large building and a tour through it.
/// Whoever reads scenes of strangers lowers these. What exceeds one is refused before it is made.
struct SceneLimits {
  std::int64_t most_tour_cells = kMostTourCells;  ///< of a tour's search grid; about 20 bytes and 1 µs each
  std::int64_t most_pieces = 1'000'000;           ///< of furniture in a building; it has a tenth as many rooms
  bool files = true;                              ///< plans, meshes and robots may be read from files
};

/// The names of rules and models that exist, which only the user of the library knows: others are refused with their
/// line. An empty list lets every name pass.
struct Vocabulary {
  struct Parameter {
    std::string model, name;
    double least = 0, most = 0;
    bool is_switch = false;  ///< true or false
  };
  std::vector<std::string> rules, sonar_models, laser_models, dependences;
  std::vector<Parameter> parameters;  ///< of models: a table [robot.sensor.MODEL] may name them
};

/// Throws SceneError.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, const Vocabulary& words = {},
                               const SceneLimits& limits = {});

/// Same for text; `name` stands for the file name in messages. Throws SceneError.
[[nodiscard]] Scene parse_scene(std::string_view text, std::string_view name, const Vocabulary& words = {},
                                const SceneLimits& limits = {});

/// Replaces the scene's robot, as [robot] use = "…" does: an embedded robot by name, or a file (its name ends in
/// .toml). The trajectory stays. Throws SceneError.
void use_robot(Scene& scene, const std::string& name_or_file, const Vocabulary& words = {});

/// TOML text that is part of the library.
struct Embedded {
  std::string_view name, text;
};

/// "default" (a furnished room of about 10 × 10 m, a ring of 24 sonars) and the worlds of the papers: "hughes1992" ...
[[nodiscard]] std::span<const Embedded> embedded_scenes() noexcept;

/// Robots for [robot] use: "hughes24", "pioneer16", "laser360" ...
[[nodiscard]] std::span<const Embedded> embedded_robots() noexcept;

/// The text of that name, or an empty one.
[[nodiscard]] std::string_view find_embedded(std::span<const Embedded> all, std::string_view name) noexcept;

/// embedded_scenes()["default"].
[[nodiscard]] std::string_view default_scene_text() noexcept;

}  // namespace evigrid::scenes
