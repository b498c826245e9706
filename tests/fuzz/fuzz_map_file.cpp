// SPDX-License-Identifier: Apache-2.0
// A damaged map file is refused; one that loads is the map that was saved. Each input is tried as it is and with its
// checksums and sizes put right, so that what lies behind them is reached too. What loads whole loads in part, and the
// part is a part of it.
#include <bit>
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
    options.region = CellRect{-70, 3, 75, 64};
    const Map part = load(bytes, options);
    for (const CellIndex at : {CellIndex{4, 3}, CellIndex{0, 40}, CellIndex{-70, 66}, CellIndex{-1, 64}}) {
      if (std::bit_cast<std::uint32_t>(part.mass(at).o) != std::bit_cast<std::uint32_t>(map.mass(at).o))
        __builtin_trap();
    }
    for (const CellIndex at : {CellIndex{5, 3}, CellIndex{0, 67}, CellIndex{-71, 40}, CellIndex{0, 2}}) {
      if (part.mass(at) != Mass{}) __builtin_trap();
    }
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
