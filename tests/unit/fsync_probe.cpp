// SPDX-License-Identifier: Apache-2.0
#include "unit/fsync_probe.hpp"

#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

extern "C" int fsync(int file) {
  using evigrid::testing::FsyncProbe;
  if (FsyncProbe::failing_from == 0) {
    errno = EIO;
    return -1;
  }
  if (FsyncProbe::failing_from > 0) --FsyncProbe::failing_from;
  struct stat what {};
  if (::fstat(file, &what) == 0 && S_ISDIR(what.st_mode)) ++FsyncProbe::folders;
  return static_cast<int>(::syscall(SYS_fsync, file));
}
