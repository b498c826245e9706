// SPDX-License-Identifier: Apache-2.0
// main() of every benchmark: refuses a build that is not optimised, and writes into the report (console and JSON) what
// a reader needs to repeat it: processor, memory, governor, operating system, compiler, flags, kernel, seeds.
// `--machine` adds the yardsticks of machine.hpp.
#include <benchmark/benchmark.h>
#include <sys/utsname.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "evigrid/evigrid.hpp"

namespace {

/// The first line of a file after `key` and its colon; the whole line without a key.
std::string line_of(const char* file, const std::string& key = "") {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::size_t colon = key.empty() ? std::string::npos : line.find(':');
    const std::size_t at = colon == std::string::npos ? 0 : line.find_first_not_of(" \t", colon + 1);
    return at == std::string::npos ? "" : line.substr(at);
  }
  return "";
}
std::string or_unknown(std::string s) { return s.empty() ? "not readable" : s; }

void describe() {
  using benchmark::AddCustomContext;
  utsname os{};
  uname(&os);
  AddCustomContext("cpu", or_unknown(line_of("/proc/cpuinfo", "model name")) + ", family " +
                              line_of("/proc/cpuinfo", "cpu family") + ", model " +
                              line_of("/proc/cpuinfo", "model\t"));
  AddCustomContext("memory", or_unknown(line_of("/proc/meminfo", "MemTotal")));
  AddCustomContext("governor", or_unknown(line_of("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")));
  AddCustomContext("huge_pages", or_unknown(line_of("/sys/kernel/mm/transparent_hugepage/enabled")));
  AddCustomContext("os", std::string(os.sysname) + " " + os.release);
  AddCustomContext("compiler", std::string(EVIGRID_BENCH_COMPILER));
  AddCustomContext("flags", std::string(EVIGRID_BENCH_FLAGS));
  AddCustomContext("evigrid", EVIGRID_VERSION ", maths " + std::to_string(evigrid::kMathsVersion));
  AddCustomContext("evigrid_kernel", std::string(evigrid::resolve_kernel_name(evigrid::Kernel::automatic)));
}

}  // namespace

int main(int argc, char** argv) {
#if !defined(NDEBUG) || !defined(__OPTIMIZE__)
  std::fprintf(stderr,
               "%s: built without optimisation or with assertions (%s); its times would mean nothing.\n"
               "Configure with -DCMAKE_BUILD_TYPE=Release.\n",
               argv[0], EVIGRID_BENCH_FLAGS);
  return 2;
#endif
  std::vector<char*> rest;
  bool machine = false;
  for (int i = 0; i < argc; ++i) {
    if (std::strcmp(argv[i], "--machine") == 0)
      machine = true;
    else
      rest.push_back(argv[i]);
  }
  int count = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  if (machine) {
    evigrid::bench::register_stream();
    evigrid::bench::register_peak();
  }
  describe();
  benchmark::Initialize(&count, rest.data());
  if (benchmark::ReportUnrecognizedArguments(count, rest.data())) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
