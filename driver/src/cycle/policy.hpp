// SPDX-License-Identifier: Apache-2.0
// What happens when a cycle would overrun its deadline.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace evigrid::driver {

enum class Policy : std::uint8_t {
  none,     ///< everything is fused, however long it takes; overruns are counted
  backlog,  ///< what does not fit waits in a bounded queue; while it is full the robots are held back. Nothing is lost
  skip      ///< what does not fit is skipped, counted and written to the log
};

std::string_view name(Policy) noexcept;
/// Throws InputError naming --policy.
Policy parse_policy(const std::string& text);

}  // namespace evigrid::driver
