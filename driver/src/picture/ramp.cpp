// SPDX-License-Identifier: Apache-2.0
#include "picture/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace evigrid::driver {
namespace {

constexpr Rgb hex(unsigned rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xFF),
          static_cast<std::uint8_t>(rgb & 0xFF)};
}
constexpr Rgb kViridis[] = {hex(0x440154), hex(0x472c7a), hex(0x3b528b), hex(0x2c728e), hex(0x21918c),
                            hex(0x28ae80), hex(0x5ec962), hex(0xaddc30), hex(0xfde725)};
constexpr Rgb kRdBu[] = {hex(0x053061), hex(0x2166ac), hex(0x4393c3), hex(0x92c5de), hex(0xd1e5f0), hex(0xf7f7f7),
                         hex(0xfddbc7), hex(0xf4a582), hex(0xd6604d), hex(0xb2182b), hex(0x67001f)};
constexpr Rgb kOranges[] = {hex(0xfff5eb), hex(0xfee6ce), hex(0xfdd0a2), hex(0xfdae6b), hex(0xfd8d3c),
                            hex(0xf16913), hex(0xd94801), hex(0xa63603), hex(0x7f2704)};
constexpr Rgb kGreys[] = {hex(0xffffff), hex(0x000000)};

std::span<const Rgb> points(Ramp ramp) noexcept {
  switch (ramp) {
    case Ramp::viridis:
      return kViridis;
    case Ramp::rdbu:
      return kRdBu;
    case Ramp::oranges:
      return kOranges;
    case Ramp::greys:
      break;
  }
  return kGreys;
}

}  // namespace

Rgb blend(Rgb a, Rgb b, double t) noexcept {
  t = t > 0 ? std::min(t, 1.0) : 0.0;
  const auto part = [t](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + t * (to - from)));
  };
  return {part(a.r, b.r), part(a.g, b.g), part(a.b, b.b)};
}

Rgb colour_of(Ramp ramp, double t) noexcept {
  const std::span<const Rgb> p = points(ramp);
  const double at = (t > 0 ? std::min(t, 1.0) : 0.0) * static_cast<double>(p.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), p.size() - 2);
  return blend(p[i], p[i + 1], at - static_cast<double>(i));
}

}  // namespace evigrid::driver
