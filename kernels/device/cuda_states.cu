// SPDX-License-Identifier: Apache-2.0
// The device's rules whose state in a map is not (e, o, u).
#include "kernels/device/cuda_launch.cuh"

namespace evigrid::kernels::device {
void fill_states(DeviceTable& t) { fill_states_here(t); }
}  // namespace evigrid::kernels::device
