// SPDX-License-Identifier: Apache-2.0
// The loop that the line-by-line readers share: fields.hpp says what it does.
#pragma once
#include "log/line_reader.hpp"

namespace evigrid::driver {

template <class Row>
void for_each_record(const Source& source, char separator, std::size_t most_fields, Log& log, Row row) {
  LineReader lines(source);
  std::string_view line;
  Tokens tokens;
  while (lines.next(line)) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    if (line[first] == '#') {
      log.skip("#");
      continue;
    }
    separator == ',' ? split_commas(line, tokens, most_fields) : split(line, tokens, most_fields);
    try {
      row(tokens, lines.line_number());
    } catch (const Malformed& bad) {
      log.reject(source.name, lines.line_number(), bad.reason, bad.detail);
    }
  }
}

}  // namespace evigrid::driver
