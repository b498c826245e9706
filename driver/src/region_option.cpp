// SPDX-License-Identifier: Apache-2.0
#include "region_option.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>

#include "error.hpp"

namespace evigrid::driver {

void add_region_option(CLI::App& command, std::vector<double>& region_m) {
  command.add_option("--region,--rect", region_m, "x0,y0,x1,y1 in metres: only this part of the map is read")
      ->delimiter(',')
      ->expected(4)
      ->allow_extra_args(false);
}

CellRect cells_of(const std::vector<double>& r, double cell_m) {
  constexpr double kFar = 1e15;  // cells
  for (const double v : r) {
    if (!(std::abs(v / cell_m) < kFar)) throw InputError(fmt::format("--region: {} m is not a place of a map", v));
  }
  if (!(r[0] < r[2] && r[1] < r[3])) throw InputError("--region: x0,y0,x1,y1 in metres, with x0 < x1 and y0 < y1");
  const auto low = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell_m + 1e-9)); };
  const auto high = [&](double v) { return static_cast<std::int64_t>(std::ceil(v / cell_m - 1e-9)); };
  return {low(r[0]), low(r[1]), high(r[2]) - low(r[0]), high(r[3]) - low(r[1])};
}

}  // namespace evigrid::driver
