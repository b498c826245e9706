// SPDX-License-Identifier: Apache-2.0
// PLY data after the header: element after element, row after row; what is not a vertex's x, y, z or a face's list of
// vertex indices is passed over. A count is believed only as far as the file has bytes for it.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "mesh/collect.hpp"
#include "mesh/ply_header.hpp"

namespace evigrid::scenes {
namespace {

class Data {
 public:
  Data(std::span<const std::byte> bytes, const PlyHeader& header, MeshCollector& mesh)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        at_(header.bytes),
        encoding_(header.encoding),
        mesh_(&mesh) {
    line_ +=
        static_cast<std::uint64_t>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
  }

  [[nodiscard]] bool ascii() const { return encoding_ == PlyEncoding::ascii; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

  /// Line of the last word of a text; in a binary file the byte that comes next.
  [[nodiscard]] std::uint64_t where() const { return ascii() ? line_ : at_; }
  [[noreturn]] void fail(std::string_view field, const std::string& message) const {
    mesh_->fail(where(), field, message);
  }

  double number(PlyType type, std::string_view field) {
    if (ascii()) return parsed<double>(field);
    switch (type) {
      case PlyType::float32:
        return static_cast<double>(std::bit_cast<float>(raw<std::uint32_t>(field)));
      case PlyType::float64:
        return std::bit_cast<double>(raw<std::uint64_t>(field));
      default:
        return static_cast<double>(integer(type, field));
    }
  }
  std::int64_t integer(PlyType type, std::string_view field) {
    if (ascii()) return parsed<std::int64_t>(field);
    switch (type) {
      case PlyType::int8:
        return static_cast<std::int8_t>(raw<std::uint8_t>(field));
      case PlyType::uint8:
        return raw<std::uint8_t>(field);
      case PlyType::int16:
        return static_cast<std::int16_t>(raw<std::uint16_t>(field));
      case PlyType::uint16:
        return raw<std::uint16_t>(field);
      case PlyType::int32:
        return static_cast<std::int32_t>(raw<std::uint32_t>(field));
      default:
        return raw<std::uint32_t>(field);
    }
  }
  /// How many items the list has that comes now: not negative, and the file is long enough.
  std::size_t count(const PlyProperty& p) {
    const std::int64_t n = integer(p.count_type, p.name);
    const std::size_t each = ascii() ? 2 : size_of(p.type);  // in a text a digit and a space, the last space left out
    if (n < 0) fail(p.name, "a list has a negative count");
    if (static_cast<std::uint64_t>(n) > (left() + 1) / each) fail(p.name, "the file ends within a list");
    return static_cast<std::size_t>(n);
  }
  void skip(const PlyProperty& p) {
    for (std::size_t n = p.is_list ? count(p) : 1; n > 0; --n) {
      if (ascii())
        word(p.name);
      else
        take(size_of(p.type), p.name);
    }
  }
  /// After the last row: nothing but white space.
  void finish() {
    if (text_.find_first_not_of(" \t\r\n", at_) != std::string_view::npos)
      fail("ply", "there is more after the last element");
  }

 private:
  std::string_view take(std::size_t n, std::string_view field) {
    if (left() < n) fail(field, "the file ends here");
    const std::string_view bytes = text_.substr(at_, n);
    at_ += n;
    return bytes;
  }
  template <class T>
  T raw(std::string_view field) {
    const std::string_view bytes = take(sizeof(T), field);
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      const std::size_t k = encoding_ == PlyEncoding::little_endian ? sizeof(T) - 1 - i : i;
      value = static_cast<T>(std::uint64_t{value} << 8 | static_cast<std::uint8_t>(bytes[k]));
    }
    return value;
  }
  std::string_view word(std::string_view field) {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string_view::npos) fail(field, "the file ends here");
    line_ += static_cast<std::uint64_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                   text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    at_ = begin;
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n", begin), text_.size());
    return take(end - begin, field);
  }
  template <class T>
  T parsed(std::string_view field) {
    std::string_view w = word(field);
    if (w.size() > 1 && w[0] == '+' && w[1] != '-') w.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error != std::errc() || end != w.data() + w.size()) fail(field, "is not a number of its type");
    return value;
  }

  std::string_view text_;
  std::size_t at_;
  std::uint64_t line_ = 1;
  PlyEncoding encoding_;
  MeshCollector* mesh_;
};

/// The header cannot promise more rows than the file has bytes for.
void check_count(const PlyElement& e, const Data& data, std::string_view name) {
  const auto fail = [&](const std::string& message) {
    throw SceneError(std::string(name) + ":" + std::to_string(e.line) + ": " + e.name + ": " + message);
  };
  if (e.count == 0) return;
  std::size_t least = 0;  // bytes of the shortest row
  for (const PlyProperty& p : e.properties) least += data.ascii() ? 2 : size_of(p.is_list ? p.count_type : p.type);
  if (least == 0) fail("has rows but no properties");
  if (e.count > (data.left() + 1) / least)
    fail("the header promises " + std::to_string(e.count) + " rows, " + std::to_string(data.left()) +
         " bytes are left");
}

void read_vertices(const PlyElement& e, Data& data, MeshCollector& mesh) {
  std::array<std::optional<std::size_t>, 3> axis_of;  // property number of x, y, z
  for (std::size_t i = 0; i < e.properties.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (e.properties[i].name == std::string_view("xyz").substr(k, 1) && !e.properties[i].is_list) axis_of[k] = i;
  if (!axis_of[0] || !axis_of[1] || !axis_of[2]) data.fail("vertex", "has no properties x, y, z");
  mesh.vertices().reserve(static_cast<std::size_t>(e.count));
  for (std::uint64_t row = 0; row < e.count; ++row) {
    std::array<double, 3> v{};
    for (std::size_t i = 0; i < e.properties.size(); ++i) {
      const auto axis = std::find(axis_of.begin(), axis_of.end(), i);
      if (axis == axis_of.end()) {
        data.skip(e.properties[i]);
        continue;
      }
      double& value = v[static_cast<std::size_t>(axis - axis_of.begin())];
      value = data.number(e.properties[i].type, e.properties[i].name);
      if (!std::isfinite(value)) data.fail(e.properties[i].name, "is not finite");
      if (std::abs(value) > kFarthest) data.fail(e.properties[i].name, "is farther than 1e12");
    }
    mesh.vertices().push_back(v);
  }
}

void read_faces(const PlyElement& e, Data& data, MeshCollector& mesh) {
  const auto is_corners = [](const PlyProperty& p) {
    return p.is_list && (p.name == "vertex_index" || p.name == "vertex_indices");
  };
  const auto list = std::find_if(e.properties.begin(), e.properties.end(), is_corners);
  if (list == e.properties.end()) data.fail("face", "has no list vertex_indices");
  if (!is_integer(list->type)) data.fail("face", "vertex_indices are not integers");
  std::vector<std::int64_t> corners;
  for (std::uint64_t row = 0; row < e.count; ++row) {
    std::uint64_t where = data.where();
    for (const PlyProperty& p : e.properties) {
      if (&p != &*list) {
        data.skip(p);
        continue;
      }
      corners.resize(data.count(p));
      if (data.ascii()) where = data.where();
      for (std::int64_t& corner : corners) corner = data.integer(p.type, p.name);
    }
    mesh.add_face(corners, where);
  }
}

}  // namespace

Mesh read_ply(std::span<const std::byte> bytes, std::string_view name) {
  const PlyHeader header = read_ply_header({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  MeshCollector mesh(name, header.encoding == PlyEncoding::ascii ? "line" : "byte");
  Data data(bytes, header, mesh);
  for (const PlyElement& e : header.elements) {
    check_count(e, data, name);
    if (e.name == "vertex") {
      read_vertices(e, data, mesh);
    } else if (e.name == "face") {
      read_faces(e, data, mesh);
    } else {
      for (std::uint64_t row = 0; row < e.count; ++row)
        for (const PlyProperty& p : e.properties) data.skip(p);
    }
  }
  data.finish();
  return mesh.finish();
}

}  // namespace evigrid::scenes
