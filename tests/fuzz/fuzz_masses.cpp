// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <sstream>

#include "csv_masses.hpp"
#include "error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  try {
    (void)evigrid::driver::read_masses(in, "fuzz.csv", size % 2 == 0 ? 2 : 3);
  } catch (const evigrid::driver::InputError&) {  // the only way to refuse
  }
  return 0;
}
