// SPDX-License-Identifier: Apache-2.0
// The log of a fleet's scans, as it is and with its checksum and its count of scans put right.
#include <cstdint>
#include <span>
#include <vector>

#include "cycle/scan_log.hpp"
#include "error.hpp"
#include "file_of.hpp"
#include "repair.hpp"

namespace {

void try_to_read(std::span<const std::byte> bytes) {
  using namespace evigrid;
  try {
    driver::ScanLogReader reader(fuzz::file_of(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    if (reader.map_bytes().size() > bytes.size()) __builtin_trap();
    driver::LoggedScan scan;
    for (std::uint64_t n = 0; reader.next(scan); ++n) {
      if (scan.scan.ranges_m.size() != reader.ranges_per_scan() || n >= reader.scans()) __builtin_trap();
    }
  } catch (const driver::InputError&) {  // the only way to refuse
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  try_to_read(bytes);
  std::vector<std::byte> repaired(bytes.begin(), bytes.end());
  evigrid::fuzz::repair_scan_log(repaired);
  try_to_read(repaired);
  return 0;
}
