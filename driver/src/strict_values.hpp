// SPDX-License-Identifier: Apache-2.0
// What the parser of the command line would take without a word: an empty value, mostly a shell variable that was not
// set, and whole numbers that are too large, negative where none may be, or octal by a leading zero.
#pragma once
#include "cli.hpp"

namespace evigrid::driver {

/// For every option of every command.
void refuse_odd_values(CLI::App& app);

}  // namespace evigrid::driver
