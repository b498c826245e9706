// SPDX-License-Identifier: Apache-2.0
#include "io/sync_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace evigrid::io {

void sync_folder_of(const std::filesystem::path& file) noexcept {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (const int d = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); d >= 0) {
    ::fsync(d);
    ::close(d);
  }
}

}  // namespace evigrid::io
