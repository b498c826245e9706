// SPDX-License-Identifier: Apache-2.0
// Readings beside true ranges, as `evigrid train` takes them.
#include <cstdint>

#include "error.hpp"
#include "file_of.hpp"
#include "revision/train.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid;
  try {
    (void)driver::read_samples(fuzz::file_of(data, size));
  } catch (const driver::InputError&) {  // the only way to refuse
  }
  return 0;
}
