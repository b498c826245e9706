// SPDX-License-Identifier: Apache-2.0
#include "saved_map.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "error.hpp"
#include "region_option.hpp"

namespace evigrid::driver {

SavedMap open_saved_map(const std::string& path, std::shared_ptr<Executor> executor,
                        const std::vector<double>& region_m) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path file = fs::is_directory(path, ignored) ? fs::path(path) / kMapFile : fs::path(path);
  try {
    MapFileInfo info = inspect(file);
    // The file may be anyone's: what it says of memory is not believed.
    LoadOptions options{.executor = std::move(executor), .memory_cap_bytes = MapParams{}.memory_cap_bytes};
    if (info.memory_bytes > *options.memory_cap_bytes) options.page_directory = fs::temp_directory_path();
    if (!region_m.empty()) options.region = cells_of(region_m, info.params.cell_m);
    std::uint64_t bytes_read = 0;
    options.bytes_read = &bytes_read;
    Map map = load(file, options);
    return {file.string(), std::move(info), std::move(map), bytes_read};
  } catch (const MapFileError& bad) {
    throw InputError(bad.what());
  } catch (const std::length_error& full) {
    throw InputError(fmt::format("{}: {}", file.string(), full.what()));
  } catch (const std::system_error& disk) {  // of the page file, and where temporary files go
    throw InputError(
        fmt::format("{}: it is larger than memory allows and needs a page file: {}", file.string(), disk.what()));
  }
}

std::string describe_map(const SavedMap& saved) {
  std::string models;
  for (const Sensor& s : saved.map.sensors()) {
    const std::string model(name(s.model));
    if (models.find(model) == std::string::npos) models += (models.empty() ? "" : " + ") + model;
  }
  return fmt::format("{}, {}, cell {:g} m", name(saved.map.params().rule), models.empty() ? "no sensor" : models,
                     saved.map.params().cell_m);
}

}  // namespace evigrid::driver
