// SPDX-License-Identifier: Apache-2.0
// The device's Dempster, Yager, DSmH.
#include "kernels/device/cuda_launch.cuh"

namespace evigrid::kernels::device {
void fill_dempster_and_yager(DeviceTable& t) { fill_dempster_and_yager_here(t); }
}  // namespace evigrid::kernels::device
