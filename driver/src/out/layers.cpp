// SPDX-License-Identifier: Apache-2.0
// masses.npy holds exactly the floats of the map; map.pgm and map.yaml are what map_server and its many clients load.
#include "out/layers.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <iterator>

#include "error.hpp"
#include "out/costmap.hpp"

namespace evigrid::driver {

static_assert(std::endian::native == std::endian::little, "masses.npy is written as the memory holds it");

void require_fits(std::string_view name, std::string_view size, double bytes, int cap_mb) {
  if (bytes <= cap_mb * 1e6) return;
  throw InputError(
      fmt::format("{} refused: {} need {:.0f} MB, more than --max-image-mb {}", name, size, bytes / 1e6, cap_mb));
}

namespace {

double cells_of(const CellRect& rect) { return static_cast<double>(rect.width) * static_cast<double>(rect.height); }
std::string size_of(const CellRect& rect) { return fmt::format("{} x {} cells", rect.width, rect.height); }
constexpr double kPlaneBytes = 4 * sizeof(float);  // of one cell; c, Con and the last conflict come on top

constexpr std::string_view kModeNames[] = {"trinary", "scale", "raw"};  // in the order of PgmMode

std::uint8_t pixel(const Layers& l, std::size_t i, PgmMode mode, const PgmThresholds& limits) {
  const double betp = value_of(Layer::betp, l.mass(i));
  switch (mode) {
    case PgmMode::trinary:
      if (l.u()[i] == 1) return 205;  // never seen, whatever the thresholds make of BetP 1/2
      return betp > limits.occupied ? 0 : betp < limits.free ? 254 : 205;
    case PgmMode::scale:
      return static_cast<std::uint8_t>(std::lround(255 * (1 - betp)));
    case PgmMode::raw:
      break;
  }
  return l.u()[i] == 1 ? 255 : static_cast<std::uint8_t>(std::lround(100 * betp));
}

}  // namespace

void require_dense_fits(const CellRect& rect, int cap_mb) {
  require_fits("masses.npy and map.pgm", size_of(rect), cells_of(rect) * (kPlaneBytes + 1), cap_mb);
}

Layers render_layers(const Map& map, int cap_mb) {
  const CellRect rect = map.bounds();
  require_dense_fits(rect, cap_mb);
  return render_layers(map, rect, "masses.npy", cap_mb);
}

Layers render_layers(const Map& map, const CellRect& rect, std::string_view name, int cap_mb) {
  Layers out;
  out.rect = rect;
  out.cell_m = map.params().cell_m;
  const std::size_t n = out.cells();
  std::vector<Layer> order{Layer::empty, Layer::bel, Layer::unknown, Layer::conflict};
  const auto also = [&](bool kept, Layer layer, int& plane) {
    if (!kept) return;
    plane = static_cast<int>(order.size());
    order.push_back(layer);
  };
  also(keeps_paradox(map.params().rule), Layer::paradox, out.paradox);
  also(map.params().keep_con, Layer::con, out.con);
  also(map.params().keep_last_conflict, Layer::last_conflict, out.last_conflict);
  require_fits(name, size_of(rect), cells_of(rect) * static_cast<double>(order.size() * sizeof(float)), cap_mb);
  out.planes.resize(order.size() * n);
  for (std::size_t i = 0; i < order.size() && n > 0; ++i) {
    map.render(order[i], out.rect, std::span(out.planes).subspan(i * n, n), out.rect.width);
  }
  return out;
}

std::string plane_names(const Layers& l) {
  std::string out = "e, o, u, running sum of conflict";
  if (l.paradox >= 0) out += ", mass on empty and occupied at once";
  if (l.con >= 0) out += ", Con";
  if (l.last_conflict >= 0) out += ", conflict of the last update";
  return out;
}

std::string npy_head(const Layers& layers) {
  return npy_head("<f4", fmt::format("({}, {}, {})", layers.count(), layers.rect.height, layers.rect.width));
}

PgmMode parse_pgm_mode(const std::string& name, const char* option) {
  for (std::size_t i = 0; i < std::size(kModeNames); ++i) {
    if (name == kModeNames[i]) return static_cast<PgmMode>(i);
  }
  throw InputError(fmt::format("{}: '{}' is unknown; known: trinary, scale, raw", option, name));
}

std::string pgm(const Layers& layers, PgmMode mode, const PgmThresholds& limits) {
  std::string out =
      fmt::format("P5\n# {} m per cell\n{} {}\n255\n", layers.cell_m, layers.rect.width, layers.rect.height);
  for (std::int64_t y = layers.rect.height - 1; y >= 0; --y) {
    for (std::int64_t x = 0; x < layers.rect.width; ++x)
      out += static_cast<char>(pixel(layers, static_cast<std::size_t>(y * layers.rect.width + x), mode, limits));
  }
  return out;
}

std::string map_yaml(const Layers& layers, const std::string& image, PgmMode mode, const PgmThresholds& limits) {
  const PgmThresholds said = mode == PgmMode::trinary ? PgmThresholds{} : limits;
  return fmt::format(
      "image: {}\nmode: {}\nresolution: {}\norigin: [{:.10g}, {:.10g}, 0]\nnegate: 0\noccupied_thresh: "
      "{}\nfree_thresh: "
      "{}\n",
      image, kModeNames[static_cast<std::size_t>(mode)], layers.cell_m,
      static_cast<double>(layers.rect.x) * layers.cell_m, static_cast<double>(layers.rect.y) * layers.cell_m,
      said.occupied, said.free);
}

}  // namespace evigrid::driver
