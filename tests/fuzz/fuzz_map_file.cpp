// SPDX-License-Identifier: Apache-2.0
// A damaged map file is refused; one that loads is the map that was saved.
#include <cstdint>
#include <span>

#include "evigrid/executor.hpp"
#include "evigrid/io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid;
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    static const std::shared_ptr<Executor> here = make_serial_executor();
    LoadOptions options;
    options.executor = here;
    options.memory_cap_bytes = 64 << 20;
    const Map map = load(bytes, options);
    if (map.hash() != inspect(bytes).hash) __builtin_trap();
  } catch (const MapFileError&) {  // the only way to refuse a file
  }
  return 0;
}
