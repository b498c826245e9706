// SPDX-License-Identifier: Apache-2.0
// The test program's own fsync: counts the folders that are brought to the disk, and fails when it is told to.
#pragma once

namespace evigrid::testing {

struct FsyncProbe {
  static inline int folders = 0;
  static inline int failing_from = -1;  ///< so many calls succeed, then all fail; -1: none fails
};

}  // namespace evigrid::testing
