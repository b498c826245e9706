// SPDX-License-Identifier: Apache-2.0
// Where the lines of a log come from: a file by its path, or bytes in memory under a name for messages (tests, fuzzing,
// data that a host already holds).
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace evigrid::driver {

struct Source {
  std::string name;                         ///< the path, or what stands for it in messages
  std::optional<std::string_view> bytes{};  ///< absent: the file of that name. Not copied: must outlive the reading
};

}  // namespace evigrid::driver
