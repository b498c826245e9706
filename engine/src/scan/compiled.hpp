// SPDX-License-Identifier: Apache-2.0
// Sensors and readings in the form the kernels take.
#pragma once
#include <memory>
#include <variant>
#include <vector>

#include "evigrid/scan.hpp"
#include "kernels/row/kernel_table.hpp"

namespace evigrid {

kernels::ConeSpec cone_spec(const Sensor&, double cell_m);
kernels::FanSpec fan_spec(const Sensor&, double cell_m);

/// A declared sensor with what depends on it alone.
struct CompiledSensor {
  Sensor sensor;
  std::variant<kernels::ConeType, kernels::FanType> type;
  CompiledSensor(const Sensor&, double cell_m);
};

/// One accepted reading, in the order of fusion: gated, then compiled.
struct Footprint {
  const CompiledSensor* sensor = nullptr;
  kernels::SensorPose pose{};
  std::int64_t stamp_ns = 0;  // of its scan
  std::size_t scan = 0;       // which one of the batch
  double range_m = 0;         // of a cone
  int cone_model = -1;        // index into the kernel table; −1 is a fan
  kernels::ConeReading cone;
  std::unique_ptr<kernels::Fan> fan;  // its ranges in metres until it is compiled
};

/// What takes the time, after the gate: each footprint by itself, in any order.
void compile(Footprint&, const kernels::KernelTable&);

}  // namespace evigrid
