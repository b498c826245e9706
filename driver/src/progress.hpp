// SPDX-License-Identifier: Apache-2.0
// One line of progress on stderr, and only where a person watches.
#pragma once
#include <cstddef>
#include <string>

namespace evigrid::driver {

class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(std::size_t done, std::size_t all);

 private:
  std::string what_;
  bool watched_;
  int last_percent_ = -1;
};

}  // namespace evigrid::driver
