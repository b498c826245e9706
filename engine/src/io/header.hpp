// SPDX-License-Identifier: Apache-2.0
// The readable part of a map file: key=value lines, one [sensor] section a sensor. A key that is missing keeps its
// default (older files); one that is unknown is an error (a newer program knew more than this one can keep).
#pragma once
#include <string>
#include <string_view>

#include "evigrid/io.hpp"

namespace evigrid::io {

/// Everything of the info but format_version, tiles and sizes.
std::string header_text(const MapFileInfo&);
/// Throws std::invalid_argument naming line and key.
MapFileInfo parse_header(std::string_view text);

}  // namespace evigrid::io
