// SPDX-License-Identifier: Apache-2.0
// Carriage return and erase-to-end: the terminal keeps no trace.
#include "progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace evigrid::driver {

Progress::Progress(std::string what) : what_(std::move(what)), watched_(::isatty(2) == 1) {}

Progress::~Progress() {
  if (watched_ && last_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t done, std::size_t all) {
  if (!watched_ || all == 0) return;
  const int percent = static_cast<int>(100 * done / all);
  if (percent == last_percent_) return;
  last_percent_ = percent;
  std::fprintf(stderr, "\r%s %3d %%", what_.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace evigrid::driver
