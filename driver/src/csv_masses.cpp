// SPDX-License-Identifier: Apache-2.0
// Strict on purpose: a mass that is no mass would give numbers that look right.
#include "csv_masses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "error.hpp"
#include "log/line_reader.hpp"

namespace evigrid::driver {
namespace {

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

/// One wanted column: its name, its source and where in the row it stands.
struct Column {
  std::string name;
  std::vector<double>* into;
  std::size_t at = 0;
};

/// 0 when the column is no mass of a source (e1, o12, c3 …).
int source_of(std::string_view column) {
  if (column.size() < 2 || column.size() > 7 || std::string_view("eoc").find(column[0]) == std::string_view::npos)
    return 0;
  int number = 0;
  for (const char digit : column.substr(1)) {
    if (digit < '0' || digit > '9') return 0;
    number = 10 * number + (digit - '0');
  }
  return column[1] == '0' ? 0 : number;
}

/// The wanted columns, source by source; other columns may be there unless they would change the result.
std::vector<Column> columns_of(const std::vector<std::string_view>& head, const std::string& name, MassRows& rows) {
  std::vector<Column> out;
  for (std::size_t s = 0; s < rows.sources.size(); ++s) {
    SourceMasses& source = rows.sources[s];
    for (const auto& [letter, into] :
         {std::pair('e', &source.e), std::pair('o', &source.o), std::pair('c', &source.c)}) {
      Column column{letter + std::to_string(s + 1), into};
      const auto times = std::count(head.begin(), head.end(), column.name);
      if (times == 0 && letter == 'c') continue;
      if (times == 0) fail(name, 1, column.name, "the column is missing from the head line");
      if (times > 1) fail(name, 1, column.name, "the column is there twice");
      column.at = static_cast<std::size_t>(std::find(head.begin(), head.end(), column.name) - head.begin());
      out.push_back(std::move(column));
    }
  }
  for (const std::string_view column : head) {
    if (const int source = source_of(column); source > static_cast<int>(rows.sources.size())) {
      fail(name, 1, column, fmt::format("more than {} sources: say --sources {} or more", rows.sources.size(), source));
    }
  }
  return out;
}

/// e + o + c of a source, the last column it has being the one to name.
void require_sum(const Column* first, const Column* last, const double* values, const std::string& name,
                 std::size_t line) {
  double sum = 0;
  std::string what;
  for (const Column* c = first; c <= last; ++c) {
    sum += values[c - first];
    what += (c == first ? "" : " + ") + c->name;
  }
  if (sum > 1 + kSlack) fail(name, line, last->name, fmt::format("{} is {}, more than 1", what, sum));
}

}  // namespace

MassRows read_masses(std::istream& in, const std::string& name, int sources) {
  if (sources < 2 || sources > kMostSources) {
    throw InputError(fmt::format("--sources: {} is not within [2, {}]", sources, kMostSources));
  }
  std::string line;
  std::vector<std::string_view> parts;
  if (!std::getline(in, line)) {
    throw InputError(fmt::format("{}: is empty, needs a head line e1,o1,e2,o2{}", name, sources > 2 ? ",..." : ""));
  }
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
  fields(line, parts);
  MassRows out;
  out.sources.resize(static_cast<std::size_t>(sources));
  const std::vector<Column> columns = columns_of(parts, name, out);
  const std::size_t width = parts.size();
  std::vector<double> values(columns.size());
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) fail(name, number, "e1", "an empty row");
    fields(line, parts);
    if (parts.size() != width)
      fail(name, number, "-", fmt::format("{} fields, the head line has {}", parts.size(), width));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string_view text = parts[columns[k].at];
      double& v = values[k];
      if (!parse_number(text, v))
        fail(name, number, columns[k].name, fmt::format("'{}' is no number", text.substr(0, 24)));
      if (!(v >= -kSlack && v <= 1 + kSlack))
        fail(name, number, columns[k].name, fmt::format("{} is not within [0, 1]", text.substr(0, 24)));
      v = std::clamp(v, 0.0, 1.0);
      columns[k].into->push_back(v);
    }
    for (std::size_t k = 0; k < columns.size();) {  // from the e of a source to the column before the next e
      std::size_t last = k;
      while (last + 1 < columns.size() && columns[last + 1].name[0] != 'e') ++last;
      require_sum(&columns[k], &columns[last], &values[k], name, number);
      k = last + 1;
    }
  }
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read", name));
  if (out.rows() == 0) throw InputError(fmt::format("{}: no row beside the head line", name));
  return out;
}

}  // namespace evigrid::driver
