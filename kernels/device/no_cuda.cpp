// SPDX-License-Identifier: Apache-2.0
// What a build without CUDA answers.
#include "kernels/device/device.hpp"

namespace evigrid::kernels {

std::unique_ptr<Device> make_cuda_device() { return nullptr; }
std::string why_no_cuda() { return "this build has no CUDA (EVIGRID_CUDA is off)"; }

}  // namespace evigrid::kernels
