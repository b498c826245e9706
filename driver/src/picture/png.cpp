// SPDX-License-Identifier: Apache-2.0
// PNG by libpng, into memory, so that a picture is a file only when it is whole.
#include <png.h>

#include <csetjmp>
#include <stdexcept>

#include "picture/canvas.hpp"

namespace evigrid::driver {
namespace {

void append(png_structp png_ptr, png_bytep data, png_size_t size) {
  auto* out = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png_ptr));
  const auto* from = reinterpret_cast<const std::byte*>(data);
  out->insert(out->end(), from, from + size);
}

[[noreturn]] void fail(png_structp, png_const_charp message) {
  throw std::runtime_error(std::string("libpng: ") + message);
}
void ignore(png_structp, png_const_charp) {}

struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

}  // namespace

std::vector<std::byte> png(const Canvas& image) {
  std::vector<std::byte> out;
  Writer w;
  w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  if (w.png == nullptr) throw std::runtime_error("libpng: no writer");
  w.info = png_create_info_struct(w.png);
  png_set_write_fn(w.png, &out, append, nullptr);
  png_set_user_limits(w.png, 0x7FFFFFFF, 0x7FFFFFFF);
  png_set_IHDR(w.png, w.info, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(w.png, 6);
  png_write_info(w.png, w.info);
  for (int y = 0; y < image.height(); ++y) png_write_row(w.png, image.row(y));
  png_write_end(w.png, nullptr);
  return out;
}

}  // namespace evigrid::driver
