// SPDX-License-Identifier: Apache-2.0
// A damaged journal is refused or cut at its end. What can be read is fused again where the work is small. Each input
// is tried as it is and with its checksums put right.
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <vector>

#include "evigrid/evigrid.hpp"
#include "file_of.hpp"
#include "repair.hpp"

namespace {

using namespace evigrid;

bool is_small(const JournalContents& journal) {
  constexpr double kMostCells = 500;  // a reading reaches
  constexpr std::size_t kMostEvents = 24, kMostRanges = 400, kMostSensors = 32;
  if (journal.events.size() > kMostEvents || journal.sensors.size() > kMostSensors) return false;
  for (const Sensor& s : journal.sensors) {
    if (!(s.max_range_m / journal.params.cell_m < kMostCells) || s.beams > 1000) return false;
  }
  std::size_t ranges = 0;
  for (const JournalEvent& e : journal.events) ranges += e.scan.bytes() / sizeof(float);
  return ranges < kMostRanges;
}

void try_to_read(std::span<const std::byte> bytes) {
  try {
    const JournalContents journal = read_journal(bytes);
    if (journal.bytes + journal.dropped != bytes.size()) __builtin_trap();
    if (!is_small(journal)) return;
    const std::string path = fuzz::file_of(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    static const std::shared_ptr<Executor> here = make_serial_executor();
    const RevisableMap map = RevisableMap::resume(path, {.executor = here, .memory_cap_bytes = 64 << 20});
    if (map.scans() > journal.events.size()) __builtin_trap();
    (void)map.map().hash();
  } catch (const MapFileError&) {       // the only way to refuse a file
  } catch (const std::length_error&) {  // the memory cap
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  try_to_read(bytes);
  std::vector<std::byte> repaired(bytes.begin(), bytes.end());
  fuzz::repair_journal(repaired);
  try_to_read(repaired);
  return 0;
}
