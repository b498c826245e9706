// SPDX-License-Identifier: Apache-2.0
// OctoMap 1.9.7: a cell is changed once a scan, and hits win over misses (computeUpdate). It is a 3-D engine: the plane
// is one layer of voxels, and it pays for 3-D keys and hash sets. `lazy`: inner nodes once, after the last scan, inside
// the timed part. `discretize`: one ray for each end voxel instead of one for each beam.
#include <octomap/octomap.h>

#include <cmath>

#include "bench/peers/laser_course.hpp"

namespace evigrid::bench {
namespace {

class OctomapLaser : public LaserPeer {
 public:
  OctomapLaser(const LaserCourse& c, bool lazy, bool discretize)
      : lazy_(lazy), discretize_(discretize), max_range_m_(c.fan.max_range_m), tree_(kCell_m) {
    for (std::size_t i = 0; i < c.poses.size(); ++i) {
      const Pose2 s = compose(c.poses[i], c.fan.T_robot_sensor);
      origins_.emplace_back(static_cast<float>(s.x_m), static_cast<float>(s.y_m), kZ);
      octomap::Pointcloud& cloud = clouds_.emplace_back();
      for (int b = 0; b < c.fan.beams; ++b) {
        const float r = c.scan(i)[b];
        if (!c.used(r)) continue;
        const double angle = s.yaw_rad + c.fan.first_beam_rad + b * c.fan.beam_step_rad;
        cloud.push_back(static_cast<float>(s.x_m + static_cast<double>(r) * std::cos(angle)),
                        static_cast<float>(s.y_m + static_cast<double>(r) * std::sin(angle)), kZ);
      }
    }
  }
  void clear() override { tree_.clear(); }
  void insert(std::size_t i) override {
    tree_.insertPointCloud(clouds_[i], origins_[i], max_range_m_, lazy_, discretize_);
  }
  void finish() override {
    if (lazy_) tree_.updateInnerOccupancy();
  }
  Seen at(CellIndex c) const override {
    const octomap::OcTreeNode* node =
        tree_.search((static_cast<double>(c.x) + 0.5) * kCell_m, (static_cast<double>(c.y) + 0.5) * kCell_m, kZ);
    return node == nullptr ? Seen::unknown : seen(node->getOccupancy());
  }
  double cells_per_scan() const override {
    octomap::OcTree tree(kCell_m);
    double cells = 0;
    for (std::size_t i = 0; i < clouds_.size(); ++i) {
      octomap::KeySet free, occupied;
      if (discretize_)
        tree.computeDiscreteUpdate(clouds_[i], origins_[i], free, occupied, max_range_m_);
      else
        tree.computeUpdate(clouds_[i], origins_[i], free, occupied, max_range_m_);
      cells += static_cast<double>(free.size() + occupied.size());
    }
    return cells / static_cast<double>(clouds_.size());
  }

 private:
  static constexpr float kZ = static_cast<float>(kCell_m / 2);
  bool lazy_, discretize_;
  double max_range_m_;
  octomap::OcTree tree_;
  std::vector<octomap::Pointcloud> clouds_;
  std::vector<octomap::point3d> origins_;
};

}  // namespace

std::unique_ptr<LaserPeer> make_octomap_laser(const LaserCourse& c, bool lazy, bool discretize) {
  return std::make_unique<OctomapLaser>(c, lazy, discretize);
}

}  // namespace evigrid::bench
