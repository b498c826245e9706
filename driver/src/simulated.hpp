// SPDX-License-Identifier: Apache-2.0
// A scene driven and cast: the same Log that a recording gives, so `run` maps it the same way.
#pragma once
#include <string>
#include <vector>

#include "evigrid/scenes/scene.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "log/log.hpp"

namespace evigrid::driver {

struct SceneInput {
  std::string name;  ///< the file, or "(embedded scene)"
  scenes::Scene scene;
};

/// The name of an embedded scene, or a file; empty: the default scene. Throws InputError naming file, line and field.
SceneInput open_scene(const std::string& name_or_path);

/// The rules and models of the engine, as scenes may name them.
scenes::Vocabulary vocabulary();

/// "default, hughes1992, …"
std::string embedded_scene_names();

/// The robot's sensors in the engine's words: sonars, then lasers.
std::vector<LogSensor> declared_sensors(const scenes::Scene& scene);

struct MappingOptions;
/// The filter that the scene names, unless the command line names one.
void use_map_options(const scenes::Scene& scene, MappingOptions& options);

struct CastOptions {
  int threads = 0;     ///< 0: as many as the machine has; the readings are the same
  bool ideal = false;  ///< no noise, no second bounce, no cross-talk
};

/// A scene's run cast piece by piece: whoever writes the readings down need not hold a long run as a whole.
class Casting {
 public:
  explicit Casting(const scenes::Scene& scene, const CastOptions& options = {});
  Casting(const Casting&) = delete;  // the simulation refers to the caster
  Casting& operator=(const Casting&) = delete;
  [[nodiscard]] const scenes::Scene& scene() const { return scene_; }  ///< without noise and echoes when ideal
  [[nodiscard]] std::vector<std::string> warnings() const;             ///< what about the way may be a slip
  [[nodiscard]] std::size_t steps() const { return simulation_.steps(); }
  [[nodiscard]] std::size_t done() const { return done_; }  ///< steps so far
  /// The steps that follow; none after the last.
  [[nodiscard]] std::vector<scenes::Step> next();

 private:
  scenes::Scene scene_;
  raycast::Scene caster_;
  scenes::Simulation simulation_;
  std::size_t done_ = 0, batch_;
  int threads_;
};

struct Simulated {
  Log log;                         ///< with the poses that the robot believes in
  std::vector<Pose2> T_map_robot;  ///< true pose of every scan
  double cast_s = 0;               ///< building the caster and casting every reading
};

/// Throws InputError when the readings would not fit into a sensible amount of memory.
Simulated simulate(const scenes::Scene& scene, const CastOptions& options = {});

}  // namespace evigrid::driver
