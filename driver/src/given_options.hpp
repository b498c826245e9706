// SPDX-License-Identifier: Apache-2.0
// Options that another choice makes meaningless are refused where they are given: ignored, they would let the user
// believe that they had been heard.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "cli.hpp"

namespace evigrid::driver {

/// Throws InputError "NAME: WHY" for the first of these options that was given.
void refuse_given(const CLI::App& command, std::initializer_list<const char*> options, const std::string& why);
/// The same for every option but these.
void refuse_given_but(const CLI::App& command, std::initializer_list<std::string_view> options, const std::string& why);

}  // namespace evigrid::driver
