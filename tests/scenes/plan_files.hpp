// SPDX-License-Identifier: Apache-2.0
// Images made byte by byte by the tests themselves (no library of the code under test is used), and plans as text: one
// row a line, the top one first, '#' occupied, '.' free, '?' unknown.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evigrid/scenes/plan.hpp"
#include "temp_folder.hpp"

namespace evigrid::scenes {

inline std::span<const std::byte> bytes_of(const std::string& s) {
  return std::as_bytes(std::span(s.data(), s.size()));
}

inline FloorPlan load_text(const std::string& bytes, const std::string& name, const ImageScale& scale = {}) {
  return load_plan_bytes(bytes_of(bytes), name, scale);
}

/// With pixels of 1 m.
inline FloorPlan load_image(const std::string& bytes, const std::string& name, ImageScale scale = {}) {
  scale.resolution_m = 1;
  return load_text(bytes, name, scale);
}

/// The message of a refused plan, "loaded" of an accepted one.
inline std::string refusal(const std::string& bytes, const std::string& name, const ImageScale& scale = {}) {
  try {
    (void)load_text(bytes, name, scale);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "loaded";
}

inline std::string rows_of(const FloorPlan& plan) {
  std::string text;
  for (std::int64_t y = plan.height - 1; y >= 0; --y) {
    for (std::int64_t x = 0; x < plan.width; ++x) text += ".#?"[static_cast<int>(plan.at(x, y))];
    text += '\n';
  }
  return text;
}

/// Pixels of 1 m, corner at (0, 0).
inline FloorPlan plan_of(const std::string& rows) {
  FloorPlan plan;
  plan.resolution_m = plan.resolution_y_m = 1;
  plan.width = static_cast<std::int64_t>(rows.find('\n'));
  plan.height = static_cast<std::int64_t>(rows.size()) / (plan.width + 1);
  for (std::int64_t y = plan.height - 1; y >= 0; --y)
    for (std::int64_t x = 0; x < plan.width; ++x) {
      const char c = rows[static_cast<std::size_t>(y * (plan.width + 1) + x)];
      plan.cells.push_back(c == '#' ? PlanCell::occupied : c == '?' ? PlanCell::unknown : PlanCell::free);
    }
  return plan;
}

inline std::string little(std::uint64_t value, int count) {
  std::string s;
  for (int i = 0; i < count; ++i) s += static_cast<char>(value >> (8 * i) & 0xff);
  return s;
}

inline std::string big(std::uint64_t value, int count) {
  const std::string s = little(value, count);
  return {s.rbegin(), s.rend()};
}

/// PNG (ISO/IEC 15948) with stored, not compressed, data. `scanlines`: each with its filter byte in front.
struct Png {
  std::uint32_t width = 0, height = 0;
  int depth = 8, colour_type = 0, interlace = 0;
  std::string scanlines{};
  std::string palette{}, transparency{};  ///< PLTE and tRNS

  static std::string chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    const std::string covered = type + data;
    for (const char c : covered) {
      crc ^= static_cast<unsigned char>(c);
      for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return big(data.size(), 4) + covered + big(crc ^ 0xffffffffu, 4);
  }
  static std::string deflate(const std::string& data) {
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
      a = (a + static_cast<unsigned char>(c)) % 65521;
      b = (b + a) % 65521;
    }
    std::string out = "\x78\x01";
    for (std::size_t at = 0; at < data.size() || at == 0; at += 65535) {
      const std::size_t n = std::min<std::size_t>(65535, data.size() - at);
      out += static_cast<char>(at + n == data.size());
      out += little(n, 2) + little(~n, 2) + data.substr(at, n);
    }
    return out + big(b << 16 | a, 4);
  }
  [[nodiscard]] std::string header() const {
    return std::string("\x89PNG\r\n\x1a\n") +
           chunk("IHDR", big(width, 4) + big(height, 4) + big(static_cast<unsigned>(depth), 1) +
                             big(static_cast<unsigned>(colour_type), 1) + std::string(2, '\0') +
                             big(static_cast<unsigned>(interlace), 1));
  }
  [[nodiscard]] std::string file() const {
    std::string out = header();
    if (!palette.empty()) out += chunk("PLTE", palette);
    if (!transparency.empty()) out += chunk("tRNS", transparency);
    return out + chunk("IDAT", deflate(scanlines)) + chunk("IEND", "");
  }
};

/// BMP with a header of `header` bytes (12, 40 … 124). `height` may be negative; `pixels` are padded rows in file
/// order.
struct Bmp {
  std::int32_t width = 0, height = 0;
  int bits = 24;
  std::string pixels{};
  std::string palette{};                 ///< entries of 4 bytes (3 for header 12)
  std::array<std::uint32_t, 4> masks{};  ///< red, green, blue, alpha
  std::uint32_t compression = 0;
  std::uint32_t header = 40;

  [[nodiscard]] std::string file() const {
    std::string h = little(header, 4);
    if (header == 12) {
      h += little(static_cast<std::uint32_t>(width), 2) + little(static_cast<std::uint32_t>(height), 2) + little(1, 2) +
           little(static_cast<unsigned>(bits), 2);
    } else {
      h += little(static_cast<std::uint32_t>(width), 4) + little(static_cast<std::uint32_t>(height), 4) + little(1, 2) +
           little(static_cast<unsigned>(bits), 2) + little(compression, 4) + little(pixels.size(), 4) +
           little(2835, 4) + little(2835, 4) + little(palette.size() / 4, 4) + little(0, 4);
      if (header >= 56 || compression == 3)
        for (const std::uint32_t m : masks) h += little(m, 4);
      if (h.size() < header) h.resize(header);
    }
    const std::size_t offset = 14 + h.size() + palette.size();
    return "BM" + little(offset + pixels.size(), 4) + little(0, 4) + little(offset, 4) + h + palette + pixels;
  }
};

using PlanFolder = TempFolder;

}  // namespace evigrid::scenes
