// SPDX-License-Identifier: Apache-2.0
// The first byte modulo 16 counts the formats, beyond them, and from 128 on, it is found out; a line "====" starts the
// next file of a log that has several. What can be read is also summed up.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "error.hpp"
#include "log/readers.hpp"
#include "log/summary.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace evigrid::driver;
  if (size == 0) return 0;
  const std::vector<std::string>& formats = log_formats();
  const std::size_t of_lines = formats.size() - 2, chosen = data[0] % 16;  // not auto, the first, and not bag, the last
  const std::string& format = formats[data[0] >= 128 || chosen >= of_lines ? 0 : 1 + chosen];
  std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::string_view kNext = "====\n";
  std::vector<std::string_view> files;
  for (std::size_t cut; (cut = rest.find(kNext)) != std::string_view::npos; rest.remove_prefix(cut + kNext.size())) {
    files.push_back(rest.substr(0, cut));
  }
  files.push_back(rest);
  try {
    const Log log = read_log_bytes(format, files);
    for (const LogReading& r : log.readings) {
      if (r.first + r.count > log.ranges_m.size() || r.sensor >= log.sensors.size()) __builtin_trap();
    }
    for (const LogScan& s : log.scans) {
      if (s.first + s.count > log.readings.size()) __builtin_trap();
    }
    (void)summary_text(summarise(log));
  } catch (const InputError&) {  // the only way to refuse a log
  }
  return 0;
}
