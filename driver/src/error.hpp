// SPDX-License-Identifier: Apache-2.0
// What the user can put right: a bad file, a bad value, a folder that cannot be written. main() answers it with exit
// code 2 and the message alone; every other exception is ours and ends with exit code 1.
#pragma once
#include <stdexcept>
#include <string>

namespace evigrid::driver {

class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace evigrid::driver
