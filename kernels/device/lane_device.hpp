// SPDX-License-Identifier: Apache-2.0
// "One number" of a device: one cell a thread, the scalar lanes' text. nvcc compiles it with --fmad=false, so that only
// what says mul_add is fused; division and root are rounded correctly by default. A C++ compiler compiles the same text
// for the emulation, which the tests run where there is no device.
#pragma once

#ifdef __CUDACC__
#define EVIGRID_FN __host__ __device__ __forceinline__
#define EVIGRID_CELL_BEGIN namespace evigrid::kernels::device {
#else  // a namespace of its own: both may be in one program
#define EVIGRID_FN inline
#define EVIGRID_CELL_BEGIN namespace evigrid::kernels::emulated {
#endif
#define EVIGRID_LAMBDA
#define EVIGRID_CELL_END }

#include "kernels/cell/lane_scalar.hpp"
