// SPDX-License-Identifier: Apache-2.0
// evigrid combine: rows of two masses each through one rule, at full precision, by the engine's own batch call.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <span>
#include <type_traits>

#include "commands.hpp"
#include "csv_masses.hpp"
#include "error.hpp"
#include "evigrid/combine.hpp"
#include "evigrid/joint.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string rule, in, out, kernel = "auto", executor = "serial";
  int threads = 0, sources = 2;
  bool in_double = false, in_order = false;
};

template <class T>
struct Masses {
  std::vector<T> e, o, u, c;  // c may be empty: none
  Masses(std::size_t n, bool with_c) : e(n), o(n), u(n), c(with_c ? n : 0) {}
  explicit Masses(const SourceMasses& s) : Masses(s.e.size(), !s.c.empty()) {
    for (std::size_t i = 0; i < e.size(); ++i) {  // u in the precision of the work, never below zero
      e[i] = static_cast<T>(s.e[i]);
      o[i] = static_cast<T>(s.o[i]);
      u[i] = T{1} - e[i] - o[i];
      if (!c.empty()) u[i] -= c[i] = static_cast<T>(s.c[i]);
      u[i] = std::max(T{0}, u[i]);
    }
  }
  [[nodiscard]] Planes<T> planes() { return {e.data(), o.data(), u.data(), c.empty() ? nullptr : c.data()}; }
  [[nodiscard]] Planes<const T> planes() const {
    return {e.data(), o.data(), u.data(), c.empty() ? nullptr : c.data()};
  }
};

/// Whether this many sources of a row are combined all at once.
bool is_joint(const Args& args, Rule rule) {
  if (args.sources <= 2 || args.in_order || !has_joint_form(rule)) return false;
  if (args.sources > kMostJointSources) {
    throw InputError(
        fmt::format("--sources: {} takes at most {} sources at once; more one after the other by --in-order",
                    name(rule), kMostJointSources));
  }
  return true;
}

template <class T>
std::string combined(const MassRows& rows, Rule rule, Kernel kernel, Executor* executor, bool joint) {
  const std::size_t n = rows.rows();
  const std::vector<Masses<T>> sources(rows.sources.begin(), rows.sources.end());
  std::vector<Planes<const T>> views;
  for (const Masses<T>& source : sources) views.push_back(source.planes());
  const std::span<const Planes<const T>> all(views);
  Masses<T> out(n, true);
  std::vector<T> conflict(n);
  std::uint64_t total = 0;
  if (joint) {
    combine_joint(rule, all, out.planes(), conflict.data(), n, executor);
  } else if constexpr (std::is_same_v<T, float>) {
    total = combine(rule, all, out.planes(), conflict.data(), n, kernel, executor);
  } else {
    total = combine(rule, all, out.planes(), conflict.data(), n, executor);
  }
  if (total > 0) {
    fmt::print(stderr, "evigrid: {} of {} {} in total conflict, answered by the rule's policy (--help)\n", total,
               n * (rows.sources.size() - 1), rows.sources.size() > 2 ? "combinations" : "rows");
  }
  constexpr int kDigits = std::numeric_limits<T>::max_digits10;
  fmt::memory_buffer csv;
  auto to = std::back_inserter(csv);
  fmt::format_to(to, "e,o,u,c,k\n");
  for (std::size_t i = 0; i < n; ++i) {
    fmt::format_to(to, "{:.{}g},{:.{}g},{:.{}g},{:.{}g},{:.{}g}\n", out.e[i], kDigits, out.o[i], kDigits, out.u[i],
                   kDigits, out.c[i], kDigits, conflict[i], kDigits);
  }
  return fmt::to_string(csv);
}

void combine_file(const Args& args) {
  const Rule rule = parse_rule(args.rule);
  const Kernel kernel = parse_kernel(args.kernel);
  const auto executor = parse_executor(args.executor, args.threads);
  const bool joint = is_joint(args, rule);
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
  const MassRows rows = args.in.empty() ? read_masses(std::cin, "(standard input)", args.sources)
                                        : read_masses(file, args.in, args.sources);
  const std::string csv = args.in_double ? combined<double>(rows, rule, kernel, executor.get(), joint)
                                         : combined<float>(rows, rule, kernel, executor.get(), joint);
  args.out.empty() ? void(std::cout << csv) : write_file(args.out, csv);
}

}  // namespace

void add_combine(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command = app.add_subcommand("combine", "combine the masses of two or more sources per row of a CSV file");
  command->add_option("--rule", args->rule, "combination rule: " + rule_names())->required();
  command->add_option("--in", args->in, "CSV file; without it standard input");
  command->add_option("-o,--out", args->out, "write to this file instead of standard output");
  command->add_flag("--double", args->in_double, "in double precision");
  command->add_option("--sources", args->sources, "sources per row: columns e1,o1 ... es,os")->capture_default_str();
  command->add_flag(
      "--in-order", args->in_order,
      "more than two sources: one after the other, as a map fuses its readings, for rules with a joint form");
  command->add_option("--kernel", args->kernel, "auto, scalar, avx2, avx512 or cuda; the result is the same")
      ->capture_default_str();
  command->add_option("--executor", args->executor, "serial, tbb, openmp or spin; the result is the same")
      ->capture_default_str();
  command->add_option("--threads", args->threads, "worker threads; 0: as many as the machine has")
      ->capture_default_str();
  command->footer(
      "Reads columns e1,o1,e2,o2 (found by the head line; unknown is 1 - e - o - c) and writes e,o,u,c,k, a row for a "
      "row:\n"
      "masses of empty, occupied, unknown, of empty and occupied at once (the paradox; m of the empty set in the open\n"
      "world), and the conflict k = e1*o2 + o1*e2.\n"
      "Columns c1, c2, ... are the sources' masses on the paradox: conjunctive and dsmc keep it, dsmh and germ_pcr2\n"
      "consume it (k then holds it too), the other pcr rules first give it back to e and o, all others drop it.\n"
      "--sources s: yager, dubois_prade, dsmh, pcr1 to pcr6, pcr5plus and pcr6plus take up to 8 sources at once "
      "(their\n"
      "joint form; k is the product mass on the empty set). The others, and all with --in-order, take them one after\n"
      "the other, 1, 2, ... s: k is the sum over the steps, and the order counts for germ_pcr2 and every rule with a\n"
      "joint form. murphy takes the mean of all s sources and combines it s - 1 times by Dempster's rule.\n"
      "For more than two sources pcr5 and pcr6 give unknown a share, as printed; pcr5plus and pcr6plus do not.\n"
      "Total conflict: Dempster's rule is undefined there and answers the vacuous mass (0, 0, 1), bayes answers 1/2;\n"
      "such rows are counted on standard error. The other rules redistribute it.\n"
      "bayes: o is the probability of occupied, from the odds of o + u/2 of each source; e = 1 - o.\n"
      "fuzzy: e and o are the memberships of empty and occupied, u = (1-e)(1-o) neither and c = e*o both: no masses.\n"
      "cautious: for sources that repeat each other (Denoeux), divided by its sum.\n"
      "Where rules coincide for two sources one computation serves: pcr3 is pcr2, pcr6, pcr5plus and pcr6plus\n"
      "are pcr5, dubois_prade is yager.\n\n"
      "Examples:\n"
      "  evigrid combine --rule pcr5 --in pairs.csv\n"
      "  printf 'e1,o1,e2,o2\\n0.6,0.1,0.2,0.7\\n' | evigrid combine --rule dempster --double\n"
      "  evigrid combine --rule pcr6plus --sources 3 --in three.csv\n"
      "  evigrid combine --rule pcr5 --sources 3 --in-order --in three.csv\n");
  command->callback([args] { combine_file(*args); });
}

}  // namespace evigrid::driver
