// SPDX-License-Identifier: Apache-2.0
// One Embree device for all indices of a scene, made when the first of them needs it.
#pragma once
#include <stdexcept>

#include "embree.hpp"

namespace evigrid::raycast {

class EmbreeDevice {
 public:
  RTCDevice get() {
    if (!device_) device_.reset(rtcNewDevice(nullptr));  // no options: thread counts are process-wide
    check(device_ != nullptr);
    return device_.get();
  }

  /// Throws when Embree reports an error or `good` is false.
  void check(bool good) const {
    if (good && rtcGetDeviceError(device_.get()) == RTC_ERROR_NONE) return;
    throw std::runtime_error("the ray caster (Embree) cannot build the scene");
  }

 private:
  embree::Device device_;
};

}  // namespace evigrid::raycast
