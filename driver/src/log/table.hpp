// SPDX-License-Identifier: Apache-2.0
// Comma-separated tables whose first line names the columns.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "error.hpp"
#include "log/fields.hpp"

namespace evigrid::driver {

/// Position of a column in the head line, if it is there.
inline std::optional<std::size_t> column(const Tokens& head, std::string_view name) {
  const auto found = std::find(head.begin(), head.end(), name);
  if (found == head.end()) return std::nullopt;
  return static_cast<std::size_t>(found - head.begin());
}

/// Calls head(tokens, where) for the first record and row(tokens, line) for the others, as for_each_record does.
/// The head's tokens live only during the call.
template <class Head, class Row>
void for_each_table_row(const Source& source, std::size_t most_fields, Log& log, Head head, Row row) {
  bool first = true;
  for_each_record(source, ',', most_fields, log, [&](const Tokens& t, std::size_t line) {
    if (first) {
      first = false;
      head(t, fmt::format("{}:{}", source.name, line));
    } else {
      row(t, line);
    }
  });
}

/// A column that must be there: throws InputError naming it.
inline std::size_t required_column(const Tokens& head, std::string_view name, const std::string& where) {
  if (const auto at = column(head, name)) return *at;
  throw InputError(fmt::format("{}:{}: the column is missing from the head line", where, name));
}

}  // namespace evigrid::driver
