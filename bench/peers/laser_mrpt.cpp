// SPDX-License-Identifier: Apache-2.0
// MRPT 2.5.8: one int8 of log odds a cell, changed once for every beam that crosses it (so many times a scan near the
// sensor); widening beams are filled triangles. The grid has its full size from the start.
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>

#include "bench/peers/laser_course.hpp"

namespace evigrid::bench {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;

class MrptLaser : public LaserPeer {
 public:
  MrptLaser(const LaserCourse& c, bool widening) : box_(c.box), widening_(widening), max_range_m_(c.fan.max_range_m) {
    set_up(grid_, c.box);
    const double opening = c.fan.beam_step_rad * (c.fan.beams - 1);
    for (std::size_t i = 0; i < c.poses.size(); ++i) {
      poses_.emplace_back(c.poses[i].x_m, c.poses[i].y_m, 0, c.poses[i].yaw_rad, 0, 0);
      CObservation2DRangeScan& o = scans_.emplace_back();
      o.aperture = static_cast<float>(opening);
      o.rightToLeft = true;
      o.maxRange = static_cast<float>(c.fan.no_return_m);
      o.sensorPose = CPose3D(c.fan.T_robot_sensor.x_m, c.fan.T_robot_sensor.y_m, 0,
                             c.fan.T_robot_sensor.yaw_rad + c.fan.first_beam_rad + opening / 2, 0, 0);
      o.resizeScan(static_cast<std::size_t>(c.fan.beams));
      for (int b = 0; b < c.fan.beams; ++b) {
        const float r = c.scan(i)[b];
        o.setScanRange(static_cast<std::size_t>(b), r);
        o.setScanRangeValidity(static_cast<std::size_t>(b), c.used(r));
      }
    }
  }
  void clear() override { grid_.fill(0.5f); }
  void insert(std::size_t i) override { grid_.insertObservation(scans_[i], poses_[i]); }
  Seen at(CellIndex c) const override {
    return seen(1 - static_cast<double>(grid_.getCell(static_cast<int>(c.x - box_.x), static_cast<int>(c.y - box_.y))));
  }
  /// Each of up to 60 scans alone on a cleared grid.
  double cells_per_scan() const override {
    COccupancyGridMap2D alone;
    set_up(alone, box_);
    const std::size_t step = std::max<std::size_t>(1, scans_.size() / 60);
    double cells = 0, counted = 0;
    for (std::size_t i = 0; i < scans_.size(); i += step) {
      alone.fill(0.5f);
      alone.insertObservation(scans_[i], poses_[i]);
      const auto& raw = alone.getRawMap();
      cells += static_cast<double>(raw.size()) - static_cast<double>(std::count(raw.begin(), raw.end(), 0));
      ++counted;
    }
    return cells / counted;
  }

 private:
  void set_up(COccupancyGridMap2D& g, CellRect box) const {
    const auto edge = [](std::int64_t cell) { return static_cast<float>(static_cast<double>(cell) * kCell_m); };
    g.setSize(edge(box.x), edge(box.x + box.width), edge(box.y), edge(box.y + box.height), static_cast<float>(kCell_m));
    g.insertionOptions.maxDistanceInsertion = static_cast<float>(max_range_m_);
    g.insertionOptions.wideningBeamsWithDistance = widening_;
    g.insertionOptions.considerInvalidRangesAsFreeSpace = false;  // evigrid refuses "no echo", too
  }
  CellRect box_;
  bool widening_;
  double max_range_m_;
  COccupancyGridMap2D grid_;
  std::vector<CObservation2DRangeScan> scans_;
  std::vector<CPose3D> poses_;
};

}  // namespace

std::unique_ptr<LaserPeer> make_mrpt_laser(const LaserCourse& c, bool widening) {
  return std::make_unique<MrptLaser>(c, widening);
}

}  // namespace evigrid::bench
