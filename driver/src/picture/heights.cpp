// SPDX-License-Identifier: Apache-2.0
#include "picture/heights.hpp"

#include <algorithm>

#include "picture/look.hpp"

namespace evigrid::driver {

Heights heights_of(const Layers& l, int most_blocks) {
  const auto longest = static_cast<double>(std::max(l.rect.width, l.rect.height));
  const std::int64_t block =
      std::max<std::int64_t>(1, (std::max(l.rect.width, l.rect.height) + most_blocks - 1) / most_blocks);
  const auto axis = [&](std::int64_t cells) {
    std::vector<double> out{-0.5 * static_cast<double>(cells) / longest};
    for (std::int64_t at = 0; at < cells; at += block) {
      const double middle = 0.5 * static_cast<double>(at + std::min(at + block, cells));
      out.push_back((middle - 0.5 * static_cast<double>(cells)) / longest);
    }
    out.push_back(0.5 * static_cast<double>(cells) / longest);
    return out;
  };
  Heights h;
  h.x = axis(l.rect.width);
  h.y = axis(l.rect.height);
  h.nx = static_cast<int>(h.x.size());
  h.ny = static_cast<int>(h.y.size());
  h.bel.assign(h.x.size() * h.y.size(), 0);
  h.seen.assign(h.bel.size(), false);
  for (std::int64_t y = 0; y < l.rect.height; ++y) {
    for (std::int64_t x = 0; x < l.rect.width; ++x) {
      const auto cell = static_cast<std::size_t>(y * l.rect.width + x);
      const std::size_t to = h.at(static_cast<int>(x / block) + 1, static_cast<int>(y / block) + 1);
      h.bel[to] = std::max(h.bel[to], l.o()[cell]);
      if (!never_seen(l, cell)) h.seen[to] = true;
    }
  }
  return h;
}

}  // namespace evigrid::driver
