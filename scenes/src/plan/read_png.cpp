// SPDX-License-Identifier: Apache-2.0
// PNG by libpng, with its own error functions: nothing is printed and no process-wide switch is touched. (Leptonica,
// which wraps the same library, lets it print, cuts 16 bits to 8 and has one verbosity for the whole process.) Samples
// are taken as they are stored, without gamma: map_server does the same.
#include <png.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "image.hpp"

namespace evigrid::scenes {
namespace {

struct Decoder {
  Bytes bytes;
  std::size_t at = 0;
  bool ended = false;  ///< asked for more bytes than there are
  std::string message;
  // Everything with a destructor lives here, outside of the function that libpng jumps out of.
  std::vector<png_byte> rows;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::int64_t width = 0, height = 0;
  int channels = 0, depth = 0;

  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

void on_error(png_structp png, png_const_charp message) {
  static_cast<Decoder*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}  // of ancillary chunks, e.g. chromaticities: of no use here

void on_read(png_structp png, png_bytep out, std::size_t count) {
  auto* d = static_cast<Decoder*>(png_get_io_ptr(png));
  if (d->bytes.size() - d->at < count) {
    d->ended = true;
    png_error(png, "the file ends early");
  }
  std::memcpy(out, d->bytes.data() + d->at, count);
  d->at += count;
}

/// False when libpng gave up.
bool read_header(Decoder& d) {
  if (setjmp(png_jmpbuf(d.png))) return false;
  png_read_info(d.png, d.info);
  d.width = png_get_image_width(d.png, d.info);
  d.height = png_get_image_height(d.png, d.info);
  return true;
}

/// Whole image into d.rows, `pass_rows` rows of memory when there is a single pass. Calls `use(y, row)` per row.
bool read_rows(Decoder& d, void (*use)(void* to, std::int64_t y, const png_byte* row), void* to) {
  if (setjmp(png_jmpbuf(d.png))) return false;
  png_set_expand(d.png);  // palettes to RGB, fewer than 8 bits to 8, transparent colours to alpha
  const int passes = png_set_interlace_handling(d.png);
  png_read_update_info(d.png, d.info);
  d.channels = png_get_channels(d.png, d.info);
  d.depth = png_get_bit_depth(d.png, d.info);
  const std::size_t stride = png_get_rowbytes(d.png, d.info);
  const std::int64_t kept = passes > 1 ? d.height : 1;
  d.rows.resize(stride * static_cast<std::size_t>(kept));
  for (int pass = 0; pass < passes; ++pass)
    for (std::int64_t y = 0; y < d.height; ++y) {
      png_byte* row = d.rows.data() + stride * static_cast<std::size_t>(y % kept);
      png_read_row(d.png, row, nullptr);
      if (pass == passes - 1) use(to, y, row);
    }
  png_read_end(d.png, nullptr);  // to the IEND chunk: without it the file is cut
  return true;
}

struct Target {
  Decoder* decoder;
  Bitmap* bitmap;
  const Shading* shading;
  std::vector<PixelRule> rule;  ///< one, made when the channels are known
};

void take_row(void* to, std::int64_t y, const png_byte* row) {
  Target& t = *static_cast<Target*>(to);
  const int channels = t.decoder->channels, colours = channels >= 3 ? 3 : 1;
  const bool wide = t.decoder->depth == 16, alpha = channels != colours;
  const std::uint32_t most = wide ? 65535 : 255;
  if (t.rule.empty()) t.rule.emplace_back(*t.shading, most * static_cast<std::uint32_t>(colours));
  const PixelRule& rule = t.rule.front();
  const auto sample = [&](std::size_t i) -> std::uint32_t {
    return wide ? static_cast<std::uint32_t>(row[2 * i] << 8 | row[2 * i + 1]) : row[i];
  };
  std::int8_t* out = t.bitmap->row_from_top(y);
  std::size_t i = 0;
  for (std::int64_t x = 0; x < t.bitmap->width; ++x) {
    std::uint32_t level = 0;
    for (int c = 0; c < colours; ++c) level += sample(i++);
    out[x] = rule.of(level, !alpha || sample(i) == most);
    i += alpha;
  }
}

[[noreturn]] void fail(const Decoder& d, const std::string& name) {
  if (d.ended)
    throw SceneError(name + ": pixels: the file ends early, after " + std::to_string(d.bytes.size()) + " bytes");
  throw SceneError(name + ": png: " + d.message + " (before byte " + std::to_string(d.at) + ")");
}

}  // namespace

Bitmap read_png(Bytes bytes, const std::string& name, const Shading& shading) {
  if (bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) != 0)
    throw SceneError(name + ": format: is not PNG: the signature is missing");
  Decoder d;
  d.bytes = bytes;
  d.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &d, on_error, on_warning);
  d.info = d.png ? png_create_info_struct(d.png) : nullptr;
  if (!d.info) throw SceneError(name + ": png: libpng cannot be set up");
  png_set_read_fn(d.png, &d, on_read);
  png_set_user_limits(d.png, 0x7fffffff, 0x7fffffff);  // ours are checked below
  png_set_chunk_malloc_max(d.png, 64u << 20);          // of texts and profiles
  if (!read_header(d)) fail(d, name);
  check_size(d.width, d.height, name);
  // Deflate shrinks to 1/1032 at best, and a pixel has at least one bit: a small file cannot ask for much memory.
  if (d.width * d.height / 8 / 1032 > static_cast<std::int64_t>(bytes.size()))
    throw SceneError(name + ": pixels: " + std::to_string(bytes.size()) + " bytes cannot hold " +
                     std::to_string(d.width) + " x " + std::to_string(d.height) + " pixels");
  Bitmap bitmap(d.width, d.height, name);
  Target target{&d, &bitmap, &shading, {}};
  if (!read_rows(d, take_row, &target)) fail(d, name);
  return bitmap;
}

}  // namespace evigrid::scenes
