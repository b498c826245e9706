// SPDX-License-Identifier: Apache-2.0
#include "document.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace evigrid::scenes {
namespace {

const toml::table kEmpty;
/// Coordinates of a scene; beyond it a slip of the keyboard is likelier than a building.
constexpr double kFarthest_m = 1e7;

/// Shortest decimal that reads back the same, whatever the locale.
std::string shown(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string words(Limits l) {
  std::string text(1, l.low_open ? '(' : '[');
  return text.append(shown(l.low)).append(", ").append(shown(l.high)).append("]");
}

std::string numbered(std::string_view key, std::size_t i) {
  return std::string(key).append("[").append(std::to_string(i)).append("]");
}

/// Levenshtein distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

Table::Table(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

std::string Table::name_of(std::string_view key) const {
  if (key.empty()) return path_.empty() ? "scene" : path_;
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::string Table::file_of(const toml::source_region& source) const { return source.path ? *source.path : file_; }

void Table::fail_at(const toml::node& node, const std::string& key, const std::string& message) const {
  const auto line = std::max<toml::source_index>(1, node.source().begin.line);
  throw SceneError(file_of(node.source()) + ":" + std::to_string(line) + ": " + name_of(key) + ": " + message);
}

void Table::fail(std::string_view key, const std::string& message) const {
  const toml::node* node = table_->get(key);
  fail_at(node ? *node : *table_, std::string(key), message);
}

const toml::node* Table::find(std::string_view key) {
  known_.emplace(key);
  return table_->get(key);
}

const toml::node& Table::get(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) fail(key, "is missing");
  return *node;
}

double Table::checked_number(const toml::node& node, const std::string& key, Limits limits) const {
  if (!node.is_number()) fail_at(node, key, "must be a number");
  // As stored: value<double>() is empty for whole numbers that no double holds exactly.
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!std::isfinite(value)) fail_at(node, key, "must be finite");
  if (value < limits.low || value > limits.high || (limits.low_open && value == limits.low))
    fail_at(node, key, "is " + shown(value) + ", must be within " + words(limits));
  return value;
}

double Table::number(std::string_view key, Limits limits) { return checked_number(get(key), std::string(key), limits); }

double Table::number_or(std::string_view key, Limits limits, double fallback) {
  const toml::node* node = find(key);
  return node ? checked_number(*node, std::string(key), limits) : fallback;
}

double Table::angle(std::string_view key, Limits limits_deg) {
  return number(key, limits_deg) * (std::numbers::pi / 180);
}

double Table::angle_or(std::string_view key, Limits limits_deg, double fallback_rad) {
  return find(key) ? angle(key, limits_deg) : fallback_rad;
}

std::int64_t Table::integer(std::string_view key, std::int64_t low, std::int64_t high) {
  const toml::node& node = get(key);
  if (!node.is_integer()) fail(key, "must be a whole number");
  const std::int64_t value = *node.value<std::int64_t>();
  if (value < low || value > high)
    fail(key, "is " + std::to_string(value) + ", must be within [" + std::to_string(low) + ", " + std::to_string(high) +
                  "]");
  return value;
}

std::string Table::text(std::string_view key) {
  const toml::node& node = get(key);
  if (!node.is_string()) fail(key, "must be text");
  std::string value = *node.value<std::string>();
  if (value.empty()) fail(key, "must not be empty");
  return value;
}

std::string Table::text_or(std::string_view key, std::string fallback) {
  return find(key) ? text(key) : std::move(fallback);
}

bool Table::boolean_or(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) fail(key, "must be true or false");
  return *node->value<bool>();
}

raycast::Point Table::checked_point(const toml::node& node, const std::string& key) const {
  const toml::array* pair = node.as_array();
  if (!pair || pair->size() != 2) fail_at(node, key, "must be a point [x, y]");
  const Limits limits{-kFarthest_m, kFarthest_m};
  return {checked_number(*pair->get(0), key, limits), checked_number(*pair->get(1), key, limits)};
}

raycast::Point Table::point(std::string_view key) { return checked_point(get(key), std::string(key)); }

Pose Table::pose(std::string_view key) {
  const toml::node& node = get(key);
  const std::string name(key);
  const toml::array* parts = node.as_array();
  if (!parts || parts->size() < 2 || parts->size() > 3) fail_at(node, name, "must be [x, y] or [x, y, yaw_deg]");
  const Limits limits{-kFarthest_m, kFarthest_m};
  Pose pose{checked_number(*parts->get(0), name, limits), checked_number(*parts->get(1), name, limits), 0};
  if (parts->size() == 3) pose.yaw_rad = checked_number(*parts->get(2), name, {-360, 360}) * (std::numbers::pi / 180);
  return pose;
}

std::vector<raycast::Point> Table::points(std::string_view key, std::size_t low, std::size_t high) {
  const toml::array* list = get(key).as_array();
  if (!list) fail(key, "must be a list of points [x, y]");
  if (list->size() < low || list->size() > high)
    fail(key, "has " + std::to_string(list->size()) + " points, must have " + std::to_string(low) + " to " +
                  std::to_string(high));
  std::vector<raycast::Point> points;
  for (const toml::node& node : *list) points.push_back(checked_point(node, numbered(key, points.size())));
  return points;
}

Table Table::table(std::string_view key) {
  const toml::node& node = get(key);
  if (!node.is_table()) fail(key, "must be a table");
  return {*node.as_table(), file_, name_of(key)};
}

Table Table::table_or_empty(std::string_view key) {
  return find(key) ? table(key) : Table(kEmpty, file_, name_of(key));
}

std::vector<Table> Table::tables(std::string_view key, std::size_t limit) {
  std::vector<Table> found;
  const toml::node* node = find(key);
  if (!node) return found;
  const toml::array* list = node->as_array();
  if (!list) fail(key, "must be a list of tables");
  if (list->size() > limit) fail(key, "has more than " + std::to_string(limit) + " entries");
  for (const toml::node& entry : *list) {
    const std::string name = numbered(key, found.size());
    if (!entry.is_table()) fail_at(entry, name, "must be a table");
    found.emplace_back(*entry.as_table(), file_, name_of(name));
  }
  return found;
}

std::vector<std::string> Table::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : *table_) names.emplace_back(key.str());
  return names;
}

/// A slip of the pen or a forgotten unit, not another word altogether.
static bool alike(std::string_view given, std::string_view known) {
  return known.starts_with(given) || distance(given, known) <= std::max<std::size_t>(2, given.size() / 2);
}

void Table::refuse_unknown_keys() const {
  for (const auto& [key, node] : *table_) {
    const std::string_view name = key.str();
    if (known_.contains(name)) continue;
    const auto nearest = std::min_element(known_.begin(), known_.end(), [&](const auto& l, const auto& r) {
      return distance(name, l) < distance(name, r);
    });
    std::string message = "is unknown";
    if (nearest != known_.end() && alike(name, *nearest)) message += "; did you mean " + *nearest + "?";
    const auto line = std::max<toml::source_index>(1, key.source().begin.line);
    throw SceneError(file_of(key.source()) + ":" + std::to_string(line) + ": " + name_of(name) + ": " + message);
  }
}

}  // namespace evigrid::scenes
