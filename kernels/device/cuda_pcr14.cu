// SPDX-License-Identifier: Apache-2.0
// The device's PCR1, PCR4.
#include "kernels/device/cuda_launch.cuh"

namespace evigrid::kernels::device {
void fill_pcr14(DeviceTable& t) { fill_pcr14_here(t); }
}  // namespace evigrid::kernels::device
