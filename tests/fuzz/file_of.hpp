// SPDX-License-Identifier: Apache-2.0
// A file in memory with a path, for readers that take nothing else. One at a time.
#pragma once
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace evigrid::fuzz {

inline std::string file_of(const std::uint8_t* data, std::size_t size) {
  static const int descriptor = ::memfd_create("evigrid-fuzz", 0);
  if (descriptor < 0 || ::ftruncate(descriptor, 0) != 0) std::abort();
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = ::pwrite(descriptor, data + done, size - done, static_cast<off_t>(done));
    if (n <= 0) std::abort();
    done += static_cast<std::size_t>(n);
  }
  return "/proc/self/fd/" + std::to_string(descriptor);
}

}  // namespace evigrid::fuzz
