// SPDX-License-Identifier: Apache-2.0
// A damaged map file is refused; one that loads is the map that was saved. Each input is tried as it is and with its
// checksums and sizes put right, so that what lies behind them is reached too.
#include <cstdint>
#include <span>
#include <vector>

#include "evigrid/combine.hpp"
#include "evigrid/executor.hpp"
#include "evigrid/io.hpp"
#include "repair.hpp"

namespace {

void try_to_load(std::span<const std::byte> bytes) {
  using namespace evigrid;
  static const std::shared_ptr<Executor> here = make_serial_executor();
  LoadOptions options;
  options.executor = here;
  options.memory_cap_bytes = 64 << 20;
  try {
    const Map map = load(bytes, options);
    const MapFileInfo info = inspect(bytes);
    if (info.maths_version == kMathsVersion && map.hash() != info.hash) __builtin_trap();
  } catch (const MapFileError&) {  // the only way to refuse a file
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  try_to_load(bytes);
  std::vector<std::byte> repaired(bytes.begin(), bytes.end());
  evigrid::fuzz::repair_map_file(repaired);
  try_to_load(repaired);
  return 0;
}
