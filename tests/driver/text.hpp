// SPDX-License-Identifier: Apache-2.0
// What a message must say, with the message itself when it does not.
#pragma once
#include <gtest/gtest.h>

#include <string_view>

namespace evigrid::driver {

inline ::testing::AssertionResult contains(std::string_view text, std::string_view part) {
  if (text.find(part) != std::string_view::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << text << "\" does not hold \"" << part << "\"";
}

inline ::testing::AssertionResult starts_with(std::string_view text, std::string_view part) {
  if (text.starts_with(part)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << text << "\" does not start with \"" << part << "\"";
}

}  // namespace evigrid::driver
