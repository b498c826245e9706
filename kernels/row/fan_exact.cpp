// SPDX-License-Identifier: Apache-2.0
#include "kernels/row/fan_exact.hpp"

#include "kernels/row/fan_class.hpp"

namespace evigrid::kernels {

int fan_class_exact(const FanReading& q, float dx, float dy, int candidate) { return fan_class(q, dx, dy, candidate); }

void decide_exactly(const FanReading& q, std::uint64_t bits, const float* dx, const float* dy, const float* beam,
                    float* cls) {
  for (; bits != 0; bits &= bits - 1) {
    const int i = __builtin_ctzll(bits);
    cls[i] = static_cast<float>(fan_class_exact(q, dx[i], dy[i], static_cast<int>(beam[i])));
  }
}

}  // namespace evigrid::kernels
