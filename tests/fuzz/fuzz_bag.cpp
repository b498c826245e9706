// SPDX-License-Identifier: Apache-2.0
// A damaged ROS bag is refused; what of it can be read is a log.
#include <cstdint>

#include "bag/bag.hpp"
#include "error.hpp"
#include "file_of.hpp"
#include "log/summary.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid::driver;
  Log log;
  try {
    read_bag(evigrid::fuzz::file_of(data, size), {}, log);
    for (const LogReading& r : log.readings) {
      if (r.first + r.count > log.ranges_m.size() || r.sensor >= log.sensors.size()) __builtin_trap();
    }
    for (const LogScan& s : log.scans) {
      if (s.first + s.count > log.readings.size()) __builtin_trap();
    }
    if (!log.scans.empty()) (void)summary_text(summarise(log));
  } catch (const InputError&) {  // the only way to refuse
  }
  return 0;
}
