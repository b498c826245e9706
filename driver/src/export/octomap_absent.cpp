// SPDX-License-Identifier: Apache-2.0
// In place of octomap_slab.cpp where OctoMap is not installed; require_built() has answered before.
#include <stdexcept>

#include "export/octomap_slab.hpp"

namespace evigrid::driver {

bool octomap_is_built() noexcept { return false; }
void write_octomap(const Exported&, const ExportOptions&, std::ostream&) { throw std::logic_error("without OctoMap"); }

}  // namespace evigrid::driver
