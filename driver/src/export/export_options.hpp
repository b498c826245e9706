// SPDX-License-Identifier: Apache-2.0
// The options that export and convert share.
#pragma once
#include <string>
#include <vector>
#include "cli.hpp"

#include "export/export.hpp"

namespace evigrid::driver {

struct ExportArgs {
  std::string out, format;  ///< format empty: by the extension of `out`
  std::vector<double> region_m, slab_m;
  ExportOptions options;

  /// Checks all that can be wrong before a map is read, options of other formats among it; fills options. Throws
  /// InputError.
  ExportFormat checked(const CLI::App& command);
};

void add_export_options(CLI::App& command, ExportArgs& args);

}  // namespace evigrid::driver
