// SPDX-License-Identifier: Apache-2.0
// Every call of CUDA is checked, and what it owns is given back.
#pragma once
#include <cuda_runtime.h>

#include <cstddef>
#include <string>

#include "kernels/device/device.hpp"

namespace evigrid::kernels {

inline void cuda_check(cudaError_t code, const char* what) {
  if (code == cudaSuccess) return;
  cudaGetLastError();  // not to be met again by the next call
  throw DeviceError(std::string("CUDA: ") + what + ": " + cudaGetErrorString(code));
}

/// Memory of the device or, pinned, of the host; grows, never keeps what it held.
template <bool kOnHost>
class CudaBuffer {
 public:
  CudaBuffer() = default;
  CudaBuffer(const CudaBuffer&) = delete;
  CudaBuffer& operator=(const CudaBuffer&) = delete;
  ~CudaBuffer() { release(); }
  template <class T>
  T* room(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes > bytes_) {
      release();
      const std::size_t more = bytes + bytes / 4;
      cuda_check(kOnHost ? cudaMallocHost(&at_, more) : cudaMalloc(&at_, more),
                 kOnHost ? "pinned memory" : "memory of the device");
      bytes_ = more;
    }
    return static_cast<T*>(at_);
  }
  template <class T>
  [[nodiscard]] T* get() const noexcept {
    return static_cast<T*>(at_);
  }
  void release() noexcept {
    if (at_ != nullptr) (void)(kOnHost ? cudaFreeHost(at_) : cudaFree(at_));
    at_ = nullptr, bytes_ = 0;
  }

 private:
  void* at_ = nullptr;
  std::size_t bytes_ = 0;
};

class CudaEvent {
 public:
  explicit CudaEvent(unsigned flags = cudaEventDefault) {
    cuda_check(cudaEventCreateWithFlags(&event_, flags), "event");
  }
  ~CudaEvent() { (void)cudaEventDestroy(event_); }
  CudaEvent(const CudaEvent&) = delete;
  CudaEvent& operator=(const CudaEvent&) = delete;
  void record(cudaStream_t s) { cuda_check(cudaEventRecord(event_, s), "event"); }
  void wait() { cuda_check(cudaEventSynchronize(event_), "wait"); }
  [[nodiscard]] double since(const CudaEvent& start) const {
    float ms = 0;
    cuda_check(cudaEventElapsedTime(&ms, start.event_, event_), "time between events");
    return 1e-3 * static_cast<double>(ms);
  }

 private:
  cudaEvent_t event_ = nullptr;
};

}  // namespace evigrid::kernels
