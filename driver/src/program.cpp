// SPDX-License-Identifier: Apache-2.0
// Commands together, and the three ways a program can end.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>

#include "commands.hpp"
#include "error.hpp"
#include "evigrid/version.hpp"
#include "strict_values.hpp"

namespace evigrid::driver {
namespace {

/// The parser itself would only say that a command is required.
void require_known_command(const CLI::App& app, const std::string& first) {
  if (first.empty() || first.front() == '-') return;
  std::string known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == first) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw InputError("command '" + first + "' is unknown; known: " + known);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  constexpr int kOk = 0, kInternal = 1, kBadInput = 2;
  try {
    CLI::App app("evigrid: range readings in, evidential occupancy map out", "evigrid");
    app.set_version_flag("--version", "evigrid " EVIGRID_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Every command has --help with examples.\nExit codes: 0 success, 2 bad input or usage, 1 internal error.");
    add_map(app);
    add_run(app);
    add_log(app);
    add_calibrate(app);
    add_train(app);
    add_cast(app);
    add_compare(app);
    add_combine(app);
    add_model(app);
    add_show(app);
    add_diff(app);
    add_merge(app);
    add_export(app);
    add_convert(app);
    add_paper(app);
    add_cycle(app);
    add_info(app);
    refuse_odd_values(app);
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
      return std::string("evigrid: ") + error.what() + "\nRun with --help for more information.\n";
    });
    require_known_command(app, argc > 1 ? argv[1] : "");
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (app.exit(error) != 0) return kBadInput;  // prints help, the version, or what is wrong
    }
    std::cout.flush();
    if (!std::cout) throw InputError("standard output: cannot be written");
    return kOk;
  } catch (const InputError& error) {
    std::cerr << "evigrid: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "evigrid: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "evigrid: internal error: " << error.what() << '\n';
  }
  return kInternal;
}

}  // namespace evigrid::driver
