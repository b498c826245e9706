// SPDX-License-Identifier: Apache-2.0
// Sensors and readings in the form the kernels take.
#pragma once
#include <memory>
#include <variant>
#include <vector>

#include "evigrid/scan.hpp"
#include "kernels/row/compile_reading.hpp"

namespace evigrid {

kernels::ConeSpec cone_spec(const Sensor&, double cell_m);
kernels::FanSpec fan_spec(const Sensor&, double cell_m);

/// A declared sensor with what depends on it alone.
struct CompiledSensor {
  Sensor sensor;
  std::variant<kernels::ConeType, kernels::FanSpec> type;
  CompiledSensor(const Sensor&, double cell_m);
};

/// One accepted reading, in the order of fusion.
struct Footprint {
  int cone_model = -1;  // index into the kernel table; −1 is a fan
  kernels::ConeReading cone;
  std::unique_ptr<kernels::Fan> fan;
};

}  // namespace evigrid
