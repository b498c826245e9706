// SPDX-License-Identifier: Apache-2.0
// A PNG read back by libpng, for tests that look at pixels.
#pragma once
#include <png.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "picture/canvas.hpp"

namespace evigrid::driver {

struct DecodedPng {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
  [[nodiscard]] Rgb get(int x, int y) const {
    const auto i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {pixels[i], pixels[i + 1], pixels[i + 2]};
  }
};

inline DecodedPng decode_png(const void* bytes, std::size_t size) {
  DecodedPng out;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes, size)) {
    ADD_FAILURE() << image.message;
    return out;
  }
  image.format = PNG_FORMAT_RGB;
  out.width = static_cast<int>(image.width);
  out.height = static_cast<int>(image.height);
  out.pixels.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, out.pixels.data(), 0, nullptr)) ADD_FAILURE() << image.message;
  return out;
}
inline DecodedPng decode_png(const std::string& file) { return decode_png(file.data(), file.size()); }

}  // namespace evigrid::driver
