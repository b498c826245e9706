// SPDX-License-Identifier: Apache-2.0
// Octile maps of the MovingAI benchmarks (movingai.com/benchmarks/formats.html): four head lines, then one character a
// cell. '.', 'G' and 'S' (swamp) can be entered; '@', 'O', 'T' (trees) and 'W' (water) stand for walls. The first row
// is on top, as in an image.
#include <charconv>
#include <string_view>

#include "readers.hpp"

namespace evigrid::scenes {
namespace {

class Lines {
 public:
  Lines(Bytes bytes, std::string name)
      : rest_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& field, const std::string& message) const {
    throw SceneError(name_ + ":" + std::to_string(line_) + ": " + field + ": " + message);
  }
  [[nodiscard]] bool ended() const { return rest_.empty(); }
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }

  std::string_view next(const std::string& field) {
    ++line_;
    if (ended()) fail(field, "is missing: the file ends here");
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
};

std::int64_t read_side(Lines& lines, std::string_view key) {
  const std::string field(key);
  const std::string_view line = lines.next(field);
  if (line.substr(0, key.size() + 1) != field + " ") lines.fail(field, "expected '" + field + " N'");
  const char *begin = line.data() + key.size() + 1, *end = line.data() + line.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) lines.fail(field, "must be a whole number");
  return value;
}

}  // namespace

Bitmap read_movingai(Bytes bytes, const std::string& name) {
  Lines lines(bytes, name);
  if (lines.next("type") != "type octile") lines.fail("type", "must be 'type octile'");
  const std::int64_t height = read_side(lines, "height"), width = read_side(lines, "width");
  check_size(width, height, name);
  if (lines.next("map") != "map") lines.fail("map", "must be the word 'map'");
  const auto need = static_cast<std::size_t>(width * height + height - 1);
  if (lines.bytes_left() < need)
    lines.fail("map", "the file ends early: " + std::to_string(lines.bytes_left()) + " bytes of cells, at least " +
                          std::to_string(need) + " needed");
  Bitmap bitmap(width, height, name);
  for (std::int64_t y = 0; y < height; ++y) {
    const std::string field = "row " + std::to_string(y);
    const std::string_view line = lines.next(field);
    if (line.size() != static_cast<std::size_t>(width))
      lines.fail(field, "has " + std::to_string(line.size()) + " cells, width is " + std::to_string(width));
    std::int8_t* out = bitmap.row_from_top(y);
    for (std::size_t x = 0; x < line.size(); ++x) {
      const char c = line[x];
      if (c == '.' || c == 'G' || c == 'S')
        out[x] = kFree;
      else if (c == '@' || c == 'O' || c == 'T' || c == 'W')
        out[x] = kOccupied;
      else
        lines.fail(field, "cell " + std::to_string(x) + " is none of . G S @ O T W");
    }
  }
  while (!lines.ended())
    if (!lines.next("map").empty()) lines.fail("map", "has more rows than height " + std::to_string(height));
  return bitmap;
}

}  // namespace evigrid::scenes
