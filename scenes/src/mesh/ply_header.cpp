// SPDX-License-Identifier: Apache-2.0
#include "mesh/ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "evigrid/scenes/scene.hpp"

namespace evigrid::scenes {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  static constexpr struct {
    std::string_view name;
    PlyType type;
  } kTypes[] = {{"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
                {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
                {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
                {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
                {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
                {"float64", PlyType::float64}};
  for (const auto& t : kTypes)
    if (t.name == name) return t.type;
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  PlyHeader read() {
    PlyHeader header;
    if (next_line() != "ply") fail("ply", "the file does not begin with \"ply\"");
    bool has_format = false;
    for (;;) {
      words_ = next_line();
      const std::string_view keyword = word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        if (has_format) fail("format", "comes twice");
        header.encoding = encoding();
        has_format = true;
      } else if (keyword == "element") {
        header.elements.push_back(element());
        if (!element_names_.insert(header.elements.back().name).second) fail("element", "comes twice");
        property_names_.clear();
      } else if (keyword == "property") {
        if (header.elements.empty()) fail("property", "stands before the first element");
        add_property(header.elements.back());
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fail(keyword.substr(0, 32), "is not a keyword of a PLY header");
      }
    }
    if (!has_format) fail("format", "is missing");
    header.bytes = at_;
    return header;
  }

 private:
  std::string_view next_line() {
    ++line_;
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) fail("end_header", "the file ends within the header");
    std::string_view line = text_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    return line;
  }
  std::string_view word() {
    const std::size_t begin = std::min(words_.find_first_not_of(" \t"), words_.size());
    const std::size_t end = std::min(words_.find_first_of(" \t", begin), words_.size());
    const std::string_view w = words_.substr(begin, end - begin);
    words_.remove_prefix(end);
    return w;
  }
  PlyEncoding encoding() {
    const std::string_view name = word();
    if (word() != "1.0") fail("format", "the version is not 1.0");
    if (name == "ascii") return PlyEncoding::ascii;
    if (name == "binary_little_endian") return PlyEncoding::little_endian;
    if (name == "binary_big_endian") return PlyEncoding::big_endian;
    fail("format", "is none of ascii, binary_little_endian, binary_big_endian");
  }
  PlyElement element() {
    PlyElement e;
    e.name = word();
    e.line = line_;
    const std::string_view count = word();
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), e.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size())
      fail("element", "the count is not a number from 0 on");
    return e;
  }
  PlyType type() {
    const std::optional<PlyType> t = type_named(word());
    if (!t) fail("property", "its type is none of the eight of PLY");
    return *t;
  }
  void add_property(PlyElement& e) {
    PlyProperty p{};
    const std::string_view all = words_;
    if (word() == "list") {
      p.is_list = true;
      p.count_type = type();
      if (!is_integer(p.count_type)) fail("property", "the count of a list is not an integer");
    } else {
      words_ = all;
    }
    p.type = type();
    p.name = word();
    if (p.name.empty()) fail("property", "has no name");
    if (!property_names_.insert(p.name).second) fail("property", p.name + " comes twice");
    e.properties.push_back(p);
  }
  [[noreturn]] void fail(std::string_view field, const std::string& message) const {
    throw SceneError(std::string(name_) + ":" + std::to_string(line_) + ": " + std::string(field) + ": " + message);
  }

  std::string_view text_, name_, words_;
  std::set<std::string> element_names_, property_names_;  // of all elements; of the last one's properties
  std::size_t at_ = 0;
  std::uint64_t line_ = 0;
};

}  // namespace

std::size_t size_of(PlyType type) {
  static constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(std::string_view text, std::string_view name) { return HeaderReader(text, name).read(); }

}  // namespace evigrid::scenes
