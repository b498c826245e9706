// SPDX-License-Identifier: Apache-2.0
// One function a command: declares its options and what happens when it was called.
#pragma once
#include "cli.hpp"

namespace evigrid::driver {

void add_map(CLI::App& app);
void add_log(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_train(CLI::App& app);
void add_run(CLI::App& app);
void add_cast(CLI::App& app);
void add_compare(CLI::App& app);
void add_combine(CLI::App& app);
void add_model(CLI::App& app);
void add_info(CLI::App& app);
void add_show(CLI::App& app);
void add_diff(CLI::App& app);
void add_merge(CLI::App& app);
void add_export(CLI::App& app);
void add_convert(CLI::App& app);
void add_paper(CLI::App& app);
void add_cycle(CLI::App& app);

/// The whole program: 0 success, 2 bad input or usage, 1 a fault of ours.
int run_program(int argc, const char* const* argv);

}  // namespace evigrid::driver
