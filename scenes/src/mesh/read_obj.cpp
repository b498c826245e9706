// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ by tinyobjloader's callback reader, which keeps nothing and opens no material file. It takes a number
// it cannot read for 0 and rounds others a little wrong, so coordinates are read again here, and indices compared, as
// their lines pass.
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <streambuf>

#include "mesh/collect.hpp"

namespace evigrid::scenes {
namespace {

/// Hands out one line at a time (ended by \n, \r\n or \r), so that a callback knows its line.
class Lines : public std::streambuf {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  [[nodiscard]] std::uint64_t number() const { return number_; }

  /// The next word after the line's keyword; empty at the end of the line.
  std::string_view next_word() {
    const std::size_t begin = words_.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words_ = {};
    const std::size_t end = std::min(words_.find_first_of(" \t", begin), words_.size());
    const std::string_view word = words_.substr(begin, end - begin);
    words_.remove_prefix(end);
    return word;
  }

 protected:
  int_type underflow() override {
    if (rest_.empty()) return traits_type::eof();
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_.assign(rest_.substr(0, end));
    line_ += '\n';
    const bool two = end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
    rest_.remove_prefix(std::min(end + (two ? 2 : 1), rest_.size()));
    ++number_;
    words_ = std::string_view(line_).substr(0, line_.size() - 1);
    next_word();
    setg(line_.data(), line_.data(), line_.data() + line_.size());
    return traits_type::to_int_type(line_.front());
  }

 private:
  std::string_view rest_, words_;
  std::string line_;
  std::uint64_t number_ = 0;
};

struct Reading {
  Lines& lines;
  MeshCollector& mesh;
  std::vector<std::int64_t> corners{};
};

double coordinate(Reading& r, const char* axis) {
  std::string_view word = r.lines.next_word();
  if (word.empty()) r.mesh.fail(r.lines.number(), "v", std::string("has no ") + axis);
  if (word.front() == '+') word.remove_prefix(1);
  double read = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), read);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(read))
    r.mesh.fail(r.lines.number(), "v", std::string(axis) + " is not a finite number");
  if (std::abs(read) > kFarthest) r.mesh.fail(r.lines.number(), "v", std::string(axis) + " is farther than 1e12");
  return read;
}

void on_vertex(void* user, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t) {
  Reading& r = *static_cast<Reading*>(user);
  const double x = coordinate(r, "x"), y = coordinate(r, "y"), z = coordinate(r, "z");
  r.mesh.vertices().push_back({x, y, z});
}

void on_face(void* user, tinyobj::index_t* indices, int count) {
  Reading& r = *static_cast<Reading*>(user);
  r.corners.clear();
  for (int i = 0; i < count; ++i) {
    const std::string_view word = r.lines.next_word();
    if (word.starts_with('#')) break;  // a comment after the face, which tinyobjloader takes for indices
    int read = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), read);
    if (error != std::errc() || (end != word.data() + word.size() && *end != '/') || read != indices[i].vertex_index)
      r.mesh.fail(r.lines.number(), "f", std::string(word) + " is not a vertex index");
    if (read == 0) r.mesh.fail(r.lines.number(), "f", "vertex indices begin at 1");
    const auto before = static_cast<std::int64_t>(r.mesh.vertices().size());
    r.corners.push_back(read > 0 ? read - 1 : before + read);
  }
  r.mesh.add_face(r.corners, r.lines.number());
}

}  // namespace

Mesh read_obj(std::span<const std::byte> bytes, std::string_view name) {
  Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  MeshCollector mesh(name, "line");
  Reading reading{lines, mesh};
  tinyobj::callback_t callback;
  callback.vertex_cb = on_vertex;
  callback.index_cb = on_face;
  callback.usemtl_cb = [](void*, const char*, int) {};  // else each one is a warning
  std::istream stream(&lines);
  std::string warnings, errors;
  const bool good = tinyobj::LoadObjWithCallback(stream, callback, &reading, nullptr, &warnings, &errors);
  if (!good || !warnings.empty() || !errors.empty()) mesh.fail(lines.number(), "obj", warnings + errors);
  return mesh.finish();
}

}  // namespace evigrid::scenes
