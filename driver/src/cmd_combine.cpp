// SPDX-License-Identifier: Apache-2.0
// evigrid combine: rows of two masses each through one rule, at full precision, by the engine's own batch call.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>

#include "commands.hpp"
#include "csv_masses.hpp"
#include "error.hpp"
#include "evigrid/combine.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string rule, in, out, kernel = "auto", executor = "serial";
  int threads = 0;
  bool in_double = false;
};

template <class T>
struct Masses {
  std::vector<T> e, o, u;
  explicit Masses(std::size_t n) : e(n), o(n), u(n) {}
  Masses(const std::vector<double>& from_e, const std::vector<double>& from_o) : Masses(from_e.size()) {
    for (std::size_t i = 0; i < e.size(); ++i) {  // u in the precision of the work, never below zero
      e[i] = static_cast<T>(from_e[i]);
      o[i] = static_cast<T>(from_o[i]);
      u[i] = std::max(T{0}, T{1} - e[i] - o[i]);
    }
  }
  [[nodiscard]] Planes<T> planes() { return {e.data(), o.data(), u.data()}; }
  [[nodiscard]] Planes<const T> planes() const { return {e.data(), o.data(), u.data()}; }
};

template <class T>
std::string combined(const MassPairs& pairs, Rule rule, Kernel kernel, Executor* executor) {
  const std::size_t n = pairs.rows();
  const Masses<T> a(pairs.columns[0], pairs.columns[1]), b(pairs.columns[2], pairs.columns[3]);
  Masses<T> c(n);
  std::vector<T> conflict(n);
  std::uint64_t total = 0;
  if constexpr (std::is_same_v<T, float>) {
    total = combine(rule, a.planes(), b.planes(), c.planes(), conflict.data(), n, kernel, executor);
  } else {
    total = combine(rule, a.planes(), b.planes(), c.planes(), conflict.data(), n, executor);
  }
  if (total > 0)
    fmt::print(stderr, "evigrid: {} of {} rows in total conflict, answered by the rule's policy (--help)\n", total, n);
  constexpr int kDigits = std::numeric_limits<T>::max_digits10;
  fmt::memory_buffer csv;
  auto to = std::back_inserter(csv);
  fmt::format_to(to, "e,o,u,c,k\n");
  for (std::size_t i = 0; i < n; ++i) {
    fmt::format_to(to, "{:.{}g},{:.{}g},{:.{}g},0,{:.{}g}\n", c.e[i], kDigits, c.o[i], kDigits, c.u[i], kDigits,
                   conflict[i], kDigits);
  }
  return fmt::to_string(csv);
}

void combine_file(const Args& args) {
  const Rule rule = parse_rule(args.rule);
  const Kernel kernel = parse_kernel(args.kernel);
  const auto executor = parse_executor(args.executor, args.threads);
  if (args.in_double && kernel != Kernel::automatic && kernel != Kernel::scalar) {
    throw InputError("--kernel: in double precision only auto or scalar runs");
  }
  if (!args.out.empty()) require_writable(args.out);
  std::ifstream file;
  if (!args.in.empty()) {
    std::error_code ignored;
    if (std::filesystem::is_directory(args.in, ignored)) throw InputError(args.in + ": is a folder, not a CSV file");
    file.open(args.in, std::ios::binary);
    if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", args.in, std::strerror(errno)));
  }
  const MassPairs pairs =
      args.in.empty() ? read_mass_pairs(std::cin, "(standard input)") : read_mass_pairs(file, args.in);
  const std::string csv = args.in_double ? combined<double>(pairs, rule, kernel, executor.get())
                                         : combined<float>(pairs, rule, kernel, executor.get());
  args.out.empty() ? void(std::cout << csv) : write_file(args.out, csv);
}

}  // namespace

void add_combine(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("combine", "combine two masses per row of a CSV file");
  command->add_option("--rule", args->rule, "combination rule: " + rule_names())->required();
  command->add_option("--in", args->in, "CSV file; without it standard input");
  command->add_option("-o,--out", args->out, "write to this file instead of standard output");
  command->add_flag("--double", args->in_double, "in double precision");
  command->add_option("--kernel", args->kernel, "auto, scalar, avx2 or avx512; the result is the same")
      ->capture_default_str();
  command->add_option("--executor", args->executor, "serial, tbb or openmp; the result is the same")
      ->capture_default_str();
  command->add_option("--threads", args->threads, "worker threads; 0: as many as the machine has")
      ->capture_default_str();
  command->footer(
      "Reads columns e1,o1,e2,o2 (found by the head line; unknown is 1 - e - o) and writes e,o,u,c,k, a row for a "
      "row:\n"
      "masses of empty, occupied, unknown, paradox (0 for today's rules), and the conflict k = e1*o2 + o1*e2.\n"
      "Total conflict: Dempster's rule is undefined there and answers the vacuous mass (0, 0, 1); such rows are "
      "counted\n"
      "on standard error. The other rules redistribute it.\n\n"
      "Examples:\n"
      "  evigrid combine --rule pcr5 --in pairs.csv\n"
      "  printf 'e1,o1,e2,o2\\n0.6,0.1,0.2,0.7\\n' | evigrid combine --rule dempster --double\n");
  command->callback([args] { combine_file(*args); });
}

}  // namespace evigrid::driver
