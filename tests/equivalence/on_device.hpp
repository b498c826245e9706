// SPDX-License-Identifier: Apache-2.0
// A map with a device behind it: the emulated one everywhere, the CUDA one where there is a GPU.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <sstream>
#include <string>

#include "device/device_map.hpp"
#include "equivalence/random_scans.hpp"
#include "evigrid/io.hpp"
#include "io/map_access.hpp"

namespace evigrid {

using testing::Drive;

inline std::unique_ptr<kernels::Device> make_device(const std::string& kind) {
  return kind == "cuda" ? kernels::make_cuda_device() : kernels::make_emulated_device();
}

class OnDevice : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "cuda" && !kernels::why_no_cuda().empty()) GTEST_SKIP() << kernels::why_no_cuda();
  }
  Map on_device(const MapParams& params, std::shared_ptr<Executor> executor = make_serial_executor()) {
    Map map(params, std::move(executor));
    MapAccess::use_device(map, std::make_unique<DeviceMap>(make_device(GetParam())));
    return map;
  }
};

inline void feed(Map& map, const Drive& d, std::size_t batch, Report* report = nullptr) {
  for (std::size_t i = 0; i < d.scans.size(); i += batch) {
    const Report r = map.integrate(std::span(d.scans).subspan(i, std::min(batch, d.scans.size() - i)));
    if (report != nullptr) *report += r;
  }
}
/// All bytes of the cells, the planes of history among them.
inline std::string cells_of(const Map& map) {
  std::ostringstream out;
  save(map, out);
  const std::string bytes = out.str();
  return bytes.substr(bytes.find("\x28\xB5\x2F\xFD"));
}

inline std::string device_name(const ::testing::TestParamInfo<std::string>& p) { return p.param; }

}  // namespace evigrid
