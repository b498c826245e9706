// SPDX-License-Identifier: Apache-2.0
// Windows bitmap (Microsoft: BITMAPCOREHEADER, BITMAPINFOHEADER, BITMAPV4HEADER, BITMAPV5HEADER), uncompressed: 1, 4
// and 8 bits with a palette, 16, 24 and 32 bits with or without masks; bottom row first, or top row first when the
// height is negative. Run-length compression is refused. (Leptonica knows neither V5 palettes nor top-down: hence our
// own.)
#include <array>
#include <bit>

#include "image.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kFileHeader = 14;

class BmpBytes {
 public:
  BmpBytes(Bytes bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& field, const std::string& message) const {
    throw SceneError(name_ + ": " + field + ": " + message);
  }
  /// Little-endian.
  [[nodiscard]] std::uint32_t number(std::size_t at, int count) const {
    need(at + static_cast<std::size_t>(count), "header");
    std::uint32_t value = 0;
    for (int i = count - 1; i >= 0; --i)
      value = value << 8 | std::to_integer<std::uint32_t>(bytes_[at + static_cast<std::size_t>(i)]);
    return value;
  }
  [[nodiscard]] std::int64_t signed_number(std::size_t at) const { return static_cast<std::int32_t>(number(at, 4)); }
  void need(std::size_t count, const char* field) const {
    if (bytes_.size() < count)
      fail(field,
           "the file ends early: " + std::to_string(bytes_.size()) + " bytes of at least " + std::to_string(count));
  }
  [[nodiscard]] const std::byte* at(std::size_t i) const { return bytes_.data() + i; }

 private:
  Bytes bytes_;
  std::string name_;
};

/// One channel of a 16- or 32-bit pixel, stretched to 0 … 255.
struct Mask {
  std::uint32_t bits = 0;
  [[nodiscard]] std::uint32_t of(std::uint32_t pixel) const {
    if (bits == 0) return 0;
    const int shift = std::countr_zero(bits);
    const std::uint64_t most = bits >> shift;
    return static_cast<std::uint32_t>(((pixel & bits) >> shift) * std::uint64_t{510} / most + 1) / 2;
  }
};

struct BmpHeader {
  std::size_t offset = 0;  ///< of the pixels
  std::int64_t width = 0, height = 0;
  bool top_down = false;
  std::uint32_t bits = 0;
  std::array<Mask, 3> colour{};
  Mask alpha{};
  std::vector<std::uint32_t> palette;  ///< sums of the three colours
};

void read_masks(const BmpBytes& b, std::uint32_t header, std::uint32_t compression, BmpHeader& h) {
  constexpr std::uint32_t kBitFields = 3, kAlphaBitFields = 6;
  if (compression == kBitFields || compression == kAlphaBitFields) {
    if (h.bits != 16 && h.bits != 32) b.fail("compression", "has masks, which need 16 or 32 bits a pixel");
    for (std::size_t c = 0; c < 3; ++c) h.colour[c].bits = b.number(kFileHeader + 40 + 4 * c, 4);
    if (header >= 56 || compression == kAlphaBitFields) h.alpha.bits = b.number(kFileHeader + 52, 4);
    for (const Mask& m : h.colour)
      if (m.bits == 0) b.fail("masks", "one is 0");
    for (const Mask& m : {h.colour[0], h.colour[1], h.colour[2], h.alpha}) {
      const std::uint32_t run = m.bits == 0 ? 0 : m.bits >> std::countr_zero(m.bits);
      if ((run & (run + 1)) != 0 || (h.bits == 16 && m.bits > 0xffff)) b.fail("masks", "one is not a run of bits");
    }
  } else if (h.bits == 16) {
    h.colour = {Mask{0x7c00}, Mask{0x03e0}, Mask{0x001f}};
  } else {
    h.colour = {Mask{0xff0000}, Mask{0xff00}, Mask{0xff}};
  }
}

BmpHeader read_header(const BmpBytes& b, const std::string& name) {
  if (b.number(0, 2) != 0x4d42) b.fail("format", "is not BMP: the file does not start with BM");
  BmpHeader h;
  h.offset = b.number(10, 4);
  const std::uint32_t header = b.number(kFileHeader, 4);
  const bool core = header == 12;
  if (!core && (header < 40 || header > 124)) b.fail("header", "has unknown length " + std::to_string(header));
  h.width = core ? b.number(18, 2) : b.signed_number(18);
  const std::int64_t height = core ? b.number(20, 2) : b.signed_number(22);
  h.top_down = height < 0;
  h.height = h.top_down ? -height : height;
  h.bits = b.number(core ? 24 : 28, 2);
  const std::uint32_t compression = core ? 0 : b.number(30, 4);
  check_size(h.width, h.height, name);
  if (compression != 0 && compression != 3 && compression != 6)
    b.fail("compression", "is " + std::to_string(compression) + "; only uncompressed bitmaps are read");
  if (h.bits == 1 || h.bits == 4 || h.bits == 8) {
    if (compression != 0) b.fail("compression", "has masks, which need 16 or 32 bits a pixel");
    const std::uint32_t full = 1u << h.bits, stated = core ? 0 : b.number(46, 4);
    if (stated > full) b.fail("palette", "has " + std::to_string(stated) + " colours, more than the bits allow");
    const std::size_t entry = core ? 3 : 4, start = kFileHeader + header;
    h.palette.resize(stated == 0 ? full : stated);
    b.need(start + entry * h.palette.size(), "palette");
    for (std::size_t i = 0; i < h.palette.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) h.palette[i] += b.number(start + entry * i + c, 1);
  } else if (h.bits == 16 || h.bits == 24 || h.bits == 32) {
    read_masks(b, header, compression, h);
  } else {
    b.fail("bits", "is " + std::to_string(h.bits) + " a pixel, must be 1, 4, 8, 16, 24 or 32");
  }
  if (h.offset < kFileHeader + header) b.fail("offset", "of the pixels lies in the header");
  return h;
}

/// The pixel of a row as a number of `bits` bits; whole bytes are little-endian, parts of bytes have the left pixel in
/// the upper bits.
std::uint32_t pixel_of(const std::byte* row, std::int64_t x, std::uint32_t bits) {
  if (bits < 8) {
    const std::int64_t bit = x * bits;
    const int shift = 8 - static_cast<int>(bits) - static_cast<int>(bit % 8);
    return std::to_integer<std::uint32_t>(row[bit / 8]) >> shift & ((1u << bits) - 1);
  }
  std::uint32_t value = 0;
  for (std::int64_t i = bits / 8 - 1, at = x * (bits / 8); i >= 0; --i)
    value = value << 8 | std::to_integer<std::uint32_t>(row[at + i]);
  return value;
}

}  // namespace

Bitmap read_bmp(Bytes bytes, const std::string& name, const Shading& shading) {
  const BmpBytes b(bytes, name);
  const BmpHeader h = read_header(b, name);
  const std::size_t stride = (static_cast<std::size_t>(h.width) * h.bits + 31) / 32 * 4;
  b.need(h.offset + stride * static_cast<std::size_t>(h.height), "pixels");
  const PixelRule rule(shading, 3 * 255);
  Bitmap bitmap(h.width, h.height, name);
  for (std::int64_t y = 0; y < h.height; ++y) {
    const std::byte* row = b.at(h.offset + stride * static_cast<std::size_t>(y));
    std::int8_t* out = bitmap.row_from_top(h.top_down ? y : h.height - 1 - y);
    for (std::int64_t x = 0; x < h.width; ++x) {
      const std::uint32_t pixel = pixel_of(row, x, h.bits);
      if (!h.palette.empty()) {
        if (pixel >= h.palette.size()) b.fail("pixels", "colour " + std::to_string(pixel) + " is not in the palette");
        out[x] = rule.of(h.palette[pixel]);
      } else {
        const std::uint32_t level = h.colour[0].of(pixel) + h.colour[1].of(pixel) + h.colour[2].of(pixel);
        out[x] = rule.of(level, h.alpha.bits == 0 || h.alpha.of(pixel) == 255);
      }
    }
  }
  return bitmap;
}

}  // namespace evigrid::scenes
