// SPDX-License-Identifier: Apache-2.0
// In place of bag.cpp where the libraries of ROS bags are not installed; require_bags() has answered before.
#include <stdexcept>

#include "bag/bag.hpp"

namespace evigrid::driver {

bool bags_are_built() noexcept { return false; }
void write_grid_bag(const Exported&, const ExportOptions&, const std::filesystem::path&) {
  throw std::logic_error("without ROS bags");
}
void read_bag(const std::string&, const BagOptions&, Log&) { throw std::logic_error("without ROS bags"); }

}  // namespace evigrid::driver
