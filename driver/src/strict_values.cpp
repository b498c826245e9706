// SPDX-License-Identifier: Apache-2.0
#include "strict_values.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdint>

namespace evigrid::driver {
namespace {

/// Empty when the text is such a number, and then it is written in the plain way.
template <class Int>
std::string make_whole(std::string& text) {
  const char *const begin = text.data() + (text.starts_with('+') ? 1 : 0), *const end = text.data() + text.size();
  Int value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || error == std::errc::invalid_argument)
    return fmt::format("'{}' is no whole number{}", text, Int(-1) < 0 ? "" : " from 0 on");
  if (error == std::errc::result_out_of_range) return fmt::format("{} is too large a number", text);
  text = fmt::format("{}", value);
  return {};
}

}  // namespace

void refuse_odd_values(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    for (CLI::Option* option : command->get_options()) {
      if (option->get_items_expected_max() == 0) continue;  // a flag
      const std::string type = option->get_type_name();
      option->transform(CLI::Validator(
          [type](std::string& value) {
            if (value.empty()) return std::string("is empty");
            if (type == "INT") return make_whole<std::int64_t>(value);
            if (type == "UINT") return make_whole<std::uint64_t>(value);
            return std::string();
          },
          ""));
    }
  }
}

}  // namespace evigrid::driver
