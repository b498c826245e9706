// SPDX-License-Identifier: Apache-2.0
// A table of a scene file, read field by field: every field is asked for by name, type and range, and what nobody asked
// for is an error. Each complaint says file, line, field and reason.
#pragma once
#include <toml++/toml.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {

/// Closed range of allowed values, and the words for it are made from the numbers.
struct Limits {
  double low, high;
  bool low_open = false;  ///< low itself is not allowed
};

class Table {
 public:
  /// `path` is the dotted name shown in messages; empty for the whole file.
  Table(const toml::table& table, std::string file, std::string path);

  double number(std::string_view key, Limits limits);
  double number_or(std::string_view key, Limits limits, double fallback);
  /// Same in degrees; answers in radians.
  double angle(std::string_view key, Limits limits_deg);
  double angle_or(std::string_view key, Limits limits_deg, double fallback_rad);
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  bool boolean_or(std::string_view key, bool fallback);
  raycast::Point point(std::string_view key);
  /// [x, y, yaw_deg], or [x, y] with yaw 0.
  Pose pose(std::string_view key);
  std::vector<raycast::Point> points(std::string_view key, std::size_t low, std::size_t high);
  Table table(std::string_view key);
  /// An absent table reads as an empty one.
  Table table_or_empty(std::string_view key);
  /// [[key]] tables; none when absent.
  std::vector<Table> tables(std::string_view key, std::size_t limit);
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Counts as asking for it: an optional field whose absence is fine is a known one.
  [[nodiscard]] bool has(std::string_view key) { return find(key) != nullptr; }

  /// To be called last: complains of the first key that was never asked for, and names the nearest known one.
  void refuse_unknown_keys() const;
  /// Complains of a field of this table (of the table itself when empty).
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  const toml::node* find(std::string_view key);
  const toml::node& get(std::string_view key);
  double checked_number(const toml::node& node, const std::string& key, Limits limits) const;
  raycast::Point checked_point(const toml::node& node, const std::string& key) const;
  [[noreturn]] void fail_at(const toml::node& node, const std::string& key, const std::string& message) const;
  [[nodiscard]] std::string name_of(std::string_view key) const;
  /// Parts of a robot that is used by the scene come from a file of their own.
  [[nodiscard]] std::string file_of(const toml::source_region& source) const;

  const toml::table* table_;
  std::string file_, path_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace evigrid::scenes
