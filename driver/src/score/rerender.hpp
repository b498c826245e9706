// SPDX-License-Identifier: Apache-2.0
// Re-rendering: what each reading should have been if the map were the world, against what it was. Needs no truth.
#pragma once
#include "log/log.hpp"
#include "out/layers.hpp"

namespace evigrid::driver {

struct Rerendered {
  std::size_t readings = 0;         ///< finite ranges within their sensor's limits that were compared
  std::size_t silent = 0;           ///< of these: the map predicts no echo within max_range_m
  double median_m = 0, mean_m = 0;  ///< of |predicted − measured| over the others; NaN when there are none
};

/// A cone's prediction is the distance of the nearest cell decided occupied (as score/ decides) whose centre lies in
/// it; a beam's the first one that it passes. Of a long log every n-th scan, so that about `most` ranges are compared.
[[nodiscard]] Rerendered rerender(const Layers& map, const Log& log, std::size_t most = 4000);

}  // namespace evigrid::driver
