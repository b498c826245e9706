// SPDX-License-Identifier: Apache-2.0
// PGM, plain (P2) and raw (P5), as netpbm's pgm(5) defines it: comments between any two tokens of the header, and in P2
// of the data; any maxval from 1 to 65535; two big-endian bytes a sample when it exceeds 255. One image a file: what
// follows the samples is ignored, as in netpbm. (Leptonica refuses maxval 100 and does not scale by it: hence our own.)
#include <string>

#include "image.hpp"

namespace evigrid::scenes {
namespace {

class PgmText {
 public:
  PgmText(Bytes bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail(const std::string& field, const std::string& message) const {
    throw SceneError(name_ + ":" + std::to_string(line_) + ": " + field + ": " + message);
  }

  int next() {
    if (at_ == bytes_.size()) return -1;
    const int c = std::to_integer<int>(bytes_[at_++]);
    line_ += c == '\n';
    return c;
  }

  /// The next number, after white space and comments; the one character that ends it is taken, too.
  std::uint32_t number(const char* field, std::int64_t index, std::uint32_t most) {
    const auto label = [&] {
      std::string words(field);
      if (index >= 0) words.append(" ").append(std::to_string(index));
      return words;
    };
    int c = next();
    while (is_space(c) || c == '#') {
      if (c == '#')
        while (c != '\n' && c != '\r' && c != -1) c = next();
      else
        c = next();
    }
    if (c == -1) fail(label(), "is missing: the file ends here");
    if (c < '0' || c > '9') fail(label(), "must be a whole number");
    std::uint64_t value = 0;
    for (; c >= '0' && c <= '9'; c = next()) {
      value = value * 10 + static_cast<std::uint64_t>(c - '0');
      if (value > most) fail(label(), "is greater than " + std::to_string(most));
    }
    if (c == '#')  // a comment right after the number
      while (c != '\n' && c != '\r' && c != -1) c = next();
    else if (c != -1 && !is_space(c))
      fail(label(), "must be a whole number");
    return static_cast<std::uint32_t>(value);
  }

 private:
  static bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  Bytes bytes_;
  std::string name_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

Bitmap read_pgm(Bytes bytes, const std::string& name, const Shading& shading) {
  PgmText text(bytes, name);
  const int p = text.next(), kind = text.next();
  if (p != 'P' || (kind != '2' && kind != '5'))
    text.fail("format", "is not PGM: the file starts with neither P2 nor P5");
  const std::int64_t width = text.number("width", -1, 1u << 30), height = text.number("height", -1, 1u << 30);
  const std::uint32_t white = text.number("maxval", -1, 65535);
  if (white == 0) text.fail("maxval", "is 0, must be within [1, 65535]");
  check_size(width, height, name);
  const std::size_t pixels = static_cast<std::size_t>(width * height), wide = white > 255 ? 2 : 1;
  // A plain sample takes two bytes, the last one perhaps one.
  const std::size_t need = kind == '5' ? pixels * wide : 2 * pixels - 1;
  if (text.left() < need)
    throw SceneError(name + ": pixels: the file ends early: " + std::to_string(text.left()) + " bytes of at least " +
                     std::to_string(need));
  const PixelRule rule(shading, white);
  Bitmap bitmap(width, height, name);
  const std::byte* in = bytes.data() + text.at();
  for (std::int64_t y = 0; y < height; ++y) {
    std::int8_t* row = bitmap.row_from_top(y);
    for (std::int64_t x = 0; x < width; ++x) {
      std::uint32_t level = 0;
      if (kind == '2') {
        level = text.number("pixel", y * width + x, white);
      } else {
        level = std::to_integer<std::uint32_t>(*in++);
        if (wide == 2) level = level << 8 | std::to_integer<std::uint32_t>(*in++);
        if (level > white)
          throw SceneError(name + ": pixel " + std::to_string(y * width + x) + ": is " + std::to_string(level) +
                           ", greater than maxval " + std::to_string(white));
      }
      row[x] = rule.of(level);
    }
  }
  return bitmap;
}

}  // namespace evigrid::scenes
