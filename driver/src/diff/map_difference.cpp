// SPDX-License-Identifier: Apache-2.0
#include "diff/map_difference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evigrid/readout.hpp"
#include "picture/look.hpp"
#include "picture/ramp.hpp"

namespace evigrid::driver {
namespace {

bool seen(const Layers& l, std::size_t i) { return !never_seen(l, i); }

bool equal_bits(const Layers& a, const Layers& b, std::size_t i) {
  const auto same = [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); };
  return same(a.e()[i], b.e()[i]) && same(a.o()[i], b.o()[i]) && same(a.u()[i], b.u()[i]) &&
         same(a.optional(a.paradox, i), b.optional(b.paradox, i));
}

/// Sums in row-major order in double: the same figures on every machine.
class Deviations {
 public:
  void add(double a, double b, CellIndex at) {
    const double d = b - a;
    sum_ += d, abs_ += std::abs(d), square_ += d * d, ++count_;
    if (std::abs(d) > out_.largest) out_.largest = std::abs(d), out_.at = at;
  }
  [[nodiscard]] Deviation result() const {
    Deviation out = out_;
    if (count_ > 0) {
      const auto n = static_cast<double>(count_);
      out.mean = sum_ / n, out.mean_abs = abs_ / n, out.rms = std::sqrt(square_ / n);
    }
    return out;
  }

 private:
  Deviation out_;
  double sum_ = 0, abs_ = 0, square_ = 0;
  std::uint64_t count_ = 0;
};

nlohmann::ordered_json json_of(const Deviation& d) {
  return {{"mean", d.mean},
          {"mean_abs", d.mean_abs},
          {"rms", d.rms},
          {"largest", d.largest},
          {"largest_at_cell", {d.at.x, d.at.y}}};
}

nlohmann::ordered_json share(double value) {
  return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

}  // namespace

CellRect box_around(const CellRect& a, const CellRect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const auto x0 = std::min(a.x, b.x), y0 = std::min(a.y, b.y);
  const auto x1 = std::max(a.x + a.width, b.x + b.width), y1 = std::max(a.y + a.height, b.y + b.height);
  return {x0, y0, x1 - x0, y1 - y0};
}

MapDifference difference(const Layers& a, const Layers& b) {
  if (a.rect.x != b.rect.x || a.rect.y != b.rect.y || a.rect.width != b.rect.width || a.rect.height != b.rect.height)
    throw std::invalid_argument("difference: the two maps are not rendered over one rectangle");
  MapDifference out;
  out.rect = a.rect;
  Deviations e, o, u, p;
  for (std::size_t i = 0; i < a.cells(); ++i) {
    const bool in_a = seen(a, i), in_b = seen(b, i);
    out.seen_a += in_a, out.seen_b += in_b, out.seen_both += in_a && in_b;
    if (!in_a && !in_b) continue;
    out.same_bits += in_a && in_b && equal_bits(a, b, i);
    const auto offset = static_cast<std::int64_t>(i);
    const CellIndex at{a.rect.x + offset % a.rect.width, a.rect.y + offset / a.rect.width};
    e.add(a.e()[i], b.e()[i], at);
    o.add(a.o()[i], b.o()[i], at);
    u.add(a.u()[i], b.u()[i], at);
    p.add(evigrid::value_of(Layer::betp, a.mass(i)), evigrid::value_of(Layer::betp, b.mass(i)), at);
    ++out.decisions[static_cast<std::size_t>(decide(a.mass(i)))][static_cast<std::size_t>(decide(b.mass(i)))];
  }
  out.empty = e.result(), out.occupied = o.result(), out.unknown = u.result(), out.betp = p.result();
  const std::uint64_t alike = out.decisions[1][1] + out.decisions[2][2];
  const std::uint64_t against = out.decisions[1][2] + out.decisions[2][1];
  const auto both = static_cast<double>(alike + against);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  out.agreement = both > 0 ? static_cast<double>(alike) / both : kNone;
  out.contradict = both > 0 ? static_cast<double>(against) / both : kNone;
  return out;
}

nlohmann::ordered_json to_json(const MapDifference& d) {
  nlohmann::ordered_json out;
  out["same"] = d.same();
  out["size_cells"] = {d.rect.width, d.rect.height};
  out["origin_cells"] = {d.rect.x, d.rect.y};
  out["cells_seen"] = {{"a", d.seen_a}, {"b", d.seen_b}, {"both", d.seen_both}};
  out["cells_with_equal_bits"] = d.same_bits;
  out["difference"] = {
      {"e", json_of(d.empty)}, {"o", json_of(d.occupied)}, {"u", json_of(d.unknown)}, {"betp", json_of(d.betp)}};
  constexpr const char* kNames[] = {"unknown", "empty", "occupied"};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out["decisions_a_b"][kNames[i]][kNames[j]] = d.decisions[i][j];
  }
  out["agreement"] = share(d.agreement);
  out["contradict"] = share(d.contradict);
  return out;
}

Thumbnail difference_thumbnail(const Layers& a, const Layers& b, const SheetScale& scale) {
  return thumbnail_of(scale, [&](std::int64_t x, std::int64_t y) -> std::pair<float, Rgb> {
    x -= a.rect.x, y -= a.rect.y;
    if (x < 0 || y < 0 || x >= a.rect.width || y >= a.rect.height) return {-0.5F, kNeverSeen};
    const auto i = static_cast<std::size_t>(y * a.rect.width + x);
    if (!seen(a, i) && !seen(b, i)) return {-0.5F, kNeverSeen};
    const double d = evigrid::value_of(Layer::betp, b.mass(i)) - evigrid::value_of(Layer::betp, a.mass(i));
    return {static_cast<float>(std::abs(d)), colour_of(Ramp::rdbu, 0.5 + 0.5 * d)};
  });
}

}  // namespace evigrid::driver
