// SPDX-License-Identifier: Apache-2.0
// Strict on purpose: a mass that is no mass would give numbers that look right.
#include "csv_masses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "error.hpp"
#include "log/line_reader.hpp"

namespace evigrid::driver {
namespace {

constexpr std::array<std::string_view, 4> kNames{"e1", "o1", "e2", "o2"};
constexpr double kSlack = 1e-6;

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  if (s.size() >= 2 && s.front() == '"' && s.back() == '"') s = s.substr(1, s.size() - 2);
  return s;
}

void fields(std::string_view line, std::vector<std::string_view>& out) {
  out.clear();
  for (std::size_t at = 0;;) {
    const std::size_t comma = std::min(line.find(',', at), line.size());
    out.push_back(trimmed(line.substr(at, comma - at)));
    if (comma == line.size()) break;
    at = comma + 1;
  }
}

[[noreturn]] void fail(const std::string& name, std::size_t line, std::string_view column, const std::string& why) {
  throw InputError(fmt::format("{}:{}:{}: {}", name, line, column, why));
}

/// The position of each named column; other columns may be there unless they would change the result.
std::array<std::size_t, 4> positions(const std::vector<std::string_view>& head, const std::string& name) {
  std::array<std::size_t, 4> at{};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const auto times = std::count(head.begin(), head.end(), kNames[k]);
    if (times == 0) fail(name, 1, kNames[k], "the column is missing from the head line");
    if (times > 1) fail(name, 1, kNames[k], "the column is there twice");
    at[k] = static_cast<std::size_t>(std::find(head.begin(), head.end(), kNames[k]) - head.begin());
  }
  for (const std::string_view column : head) {
    const bool source = column.size() == 2 && (column[0] == 'e' || column[0] == 'o' || column[0] == 'c') &&
                        column[1] >= '1' && column[1] <= '9';
    if (source && std::find(kNames.begin(), kNames.end(), column) == kNames.end()) {
      fail(name, 1, column, "more than two sources, and paradoxical masses, are not built yet");
    }
  }
  return at;
}

}  // namespace

MassPairs read_mass_pairs(std::istream& in, const std::string& name) {
  std::string line;
  std::vector<std::string_view> parts;
  if (!std::getline(in, line)) throw InputError(fmt::format("{}: is empty, needs a head line e1,o1,e2,o2", name));
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
  fields(line, parts);
  const auto at = positions(parts, name);
  const std::size_t width = parts.size();
  MassPairs out;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) fail(name, number, "e1", "an empty row");
    fields(line, parts);
    if (parts.size() != width)
      fail(name, number, "-", fmt::format("{} fields, the head line has {}", parts.size(), width));
    double v[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string_view text = parts[at[k]];
      if (!parse_number(text, v[k]))
        fail(name, number, kNames[k], fmt::format("'{}' is no number", text.substr(0, 24)));
      if (!(v[k] >= -kSlack && v[k] <= 1 + kSlack))
        fail(name, number, kNames[k], fmt::format("{} is not within [0, 1]", text.substr(0, 24)));
      v[k] = std::clamp(v[k], 0.0, 1.0);
      out.columns[k].push_back(v[k]);
    }
    for (const std::size_t k : {std::size_t{0}, std::size_t{2}}) {
      if (v[k] + v[k + 1] > 1 + kSlack) {
        fail(name, number, kNames[k + 1],
             fmt::format("{} + {} is {}, more than 1", kNames[k], kNames[k + 1], v[k] + v[k + 1]));
      }
    }
  }
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read", name));
  if (out.rows() == 0) throw InputError(fmt::format("{}: no row beside the head line", name));
  return out;
}

}  // namespace evigrid::driver
