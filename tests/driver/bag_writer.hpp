// SPDX-License-Identifier: Apache-2.0
// Small ROS bags of a test's own making, in plain types (ROS 1's headers are C++17).
#pragma once
#include <memory>
#include <string>
#include <vector>

namespace evigrid::testing {

class BagWriter {
 public:
  enum class Packed { no, bz2, lz4 };
  explicit BagWriter(const std::string& file, Packed packed = Packed::no);
  ~BagWriter();
  /// A transform of child in parent: x, y, z, roll, pitch, yaw. `fixed`: on /tf_static.
  void transform(double t_s, const std::string& parent, const std::string& child, const std::vector<double>& xyzrpy,
                 bool fixed = false);
  void odometry(double t_s, const std::string& frame, const std::string& child, double x_m, double y_m, double yaw_rad);
  void laser(double t_s, const std::string& topic, const std::string& frame, float first_rad, float step_rad,
             const std::vector<float>& ranges_m, float least_m = 0.1F, float most_m = 10);
  void range(double t_s, const std::string& topic, const std::string& frame, float range_m, float aperture_rad = 0.3F,
             float least_m = 0.1F, float most_m = 4);
  void text(double t_s, const std::string& topic, const std::string& words);
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evigrid::testing
