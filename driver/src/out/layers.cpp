// SPDX-License-Identifier: Apache-2.0
// masses.npy holds exactly the floats of the map; map.pgm and map.yaml are what map_server and its many clients load.
#include "out/layers.hpp"

#include <fmt/format.h>

#include <bit>

#include "error.hpp"

namespace evigrid::driver {

static_assert(std::endian::native == std::endian::little, "masses.npy is written as the memory holds it");

void require_dense_fits(const CellRect& rect, int cap_mb) {
  constexpr double kBytesPerCell = 4 * sizeof(float) + 1 + 3;  // the masses, map.pgm, map.png
  const double need_mb = static_cast<double>(rect.width) * static_cast<double>(rect.height) * kBytesPerCell / 1e6;
  if (need_mb <= cap_mb) return;
  throw InputError(
      fmt::format("masses.npy, map.pgm and map.png refused: {} x {} cells need {:.0f} MB, more than --max-image-mb {}",
                  rect.width, rect.height, need_mb, cap_mb));
}

Layers render_layers(const Map& map, int cap_mb) {
  Layers out;
  out.rect = map.bounds();
  out.cell_m = map.params().cell_m;
  require_dense_fits(out.rect, cap_mb);
  const std::size_t n = out.cells();
  out.planes.resize(4 * n);
  constexpr Layer kOrder[] = {Layer::empty, Layer::bel, Layer::unknown, Layer::conflict};
  for (std::size_t i = 0; i < 4 && n > 0; ++i) {
    map.render(kOrder[i], out.rect, std::span(out.planes).subspan(i * n, n), out.rect.width);
  }
  return out;
}

std::string npy_head(const Layers& layers) {
  std::string dict = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': (4, {}, {}), }}",
                                 layers.rect.height, layers.rect.width);
  constexpr std::size_t kFixed = 10, kAlign = 64;  // magic, version, length; data starts at a multiple of 64
  const std::size_t total = (kFixed + dict.size() + 1 + kAlign - 1) / kAlign * kAlign;
  dict.resize(total - kFixed - 1, ' ');
  dict += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(dict.size() & 0xFF);
  head += static_cast<char>(dict.size() >> 8);
  return head + dict;
}

std::string pgm(const Layers& layers) {
  std::string out =
      fmt::format("P5\n# {} m per cell\n{} {}\n255\n", layers.cell_m, layers.rect.width, layers.rect.height);
  for (std::int64_t y = layers.rect.height - 1; y >= 0; --y) {
    for (std::int64_t x = 0; x < layers.rect.width; ++x) {
      const auto i = static_cast<std::size_t>(y * layers.rect.width + x);
      const double betp = layers.o()[i] + 0.5 * layers.u()[i];
      out += static_cast<char>(betp > kOccupiedThreshold ? 0 : betp < kFreeThreshold ? 254 : 205);
    }
  }
  return out;
}

std::string map_yaml(const Layers& layers, const std::string& image) {
  return fmt::format(
      "image: {}\nmode: trinary\nresolution: {}\norigin: [{:.10g}, {:.10g}, 0]\nnegate: 0\noccupied_thresh: "
      "{}\nfree_thresh: "
      "{}\n",
      image, layers.cell_m, static_cast<double>(layers.rect.x) * layers.cell_m,
      static_cast<double>(layers.rect.y) * layers.cell_m, kOccupiedThreshold, kFreeThreshold);
}

}  // namespace evigrid::driver
