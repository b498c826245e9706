// SPDX-License-Identifier: Apache-2.0
#include "out/costmap.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

namespace evigrid::driver {
namespace {

template <class T>
std::vector<T> rendered(const Map& map, CellRect rect) {
  std::vector<T> out(static_cast<std::size_t>(rect.width * rect.height));
  map.render(Costmap{}, rect, out, rect.width);
  return out;
}

template <class T>
std::string npy(const Map& map, CellRect rect, const std::string& descr) {
  const std::vector<T> cells = rendered<T>(map, rect);
  std::string out = npy_head(descr, fmt::format("({}, {})", rect.height, rect.width));
  return out.append(reinterpret_cast<const char*>(cells.data()), cells.size());
}

}  // namespace

std::string npy_head(const std::string& descr, const std::string& shape) {
  std::string dict = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", descr, shape);
  constexpr std::size_t kFixed = 10, kAlign = 64;  // magic, version, length; data starts at a multiple of 64
  const std::size_t total = (kFixed + dict.size() + 1 + kAlign - 1) / kAlign * kAlign;
  dict.resize(total - kFixed - 1, ' ');
  dict += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(dict.size() & 0xFF);
  head += static_cast<char>(dict.size() >> 8);
  return head + dict;
}

std::string occupancy_npy(const Map& map, CellRect rect) { return npy<std::int8_t>(map, rect, "|i1"); }
std::string costmap_npy(const Map& map, CellRect rect) { return npy<std::uint8_t>(map, rect, "|u1"); }

std::string costmap_pgm(const Map& map, CellRect rect) {
  const std::vector<std::uint8_t> cells = rendered<std::uint8_t>(map, rect);
  std::string out = fmt::format("P5\n# costmap_2d: 0 free, 1-252 by BetP, 254 lethal, 255 no information\n{} {}\n255\n",
                                rect.width, rect.height);
  const auto width = static_cast<std::size_t>(rect.width);
  for (std::size_t y = static_cast<std::size_t>(rect.height); y-- > 0;)
    out.append(reinterpret_cast<const char*>(cells.data()) + y * width, width);
  return out;
}

}  // namespace evigrid::driver
