// SPDX-License-Identifier: Apache-2.0
#include "given_options.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "error.hpp"

namespace evigrid::driver {

void refuse_given(const CLI::App& command, std::initializer_list<const char*> options, const std::string& why) {
  for (const char* option : options) {
    if (command.count(option) > 0) throw InputError(std::string(option) + ": " + why);
  }
}

void refuse_given_but(const CLI::App& command, std::initializer_list<std::string_view> options,
                      const std::string& why) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && std::find(options.begin(), options.end(), name) == options.end())
      throw InputError(name + ": " + why);
  }
}

}  // namespace evigrid::driver
