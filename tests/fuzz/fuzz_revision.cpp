// SPDX-License-Identifier: Apache-2.0
// The file of a learned revision; what it holds revises.
#include <cmath>
#include <cstdint>

#include "error.hpp"
#include "file_of.hpp"
#include "revision/network.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid;
  try {
    for (const driver::Revision& r : driver::read_revisions(fuzz::file_of(data, size))) {
      for (const double m : driver::revise(r.network, {0.5, 0.2, 0.2, 0.1})) {
        if (!(m >= 0 && m <= 1)) __builtin_trap();
      }
    }
  } catch (const driver::InputError&) {  // the only way to refuse
  }
  return 0;
}
