// SPDX-License-Identifier: Apache-2.0
// The program. All of it is in the library evigrid_driver, so that tests reach it.
#include "commands.hpp"

int main(int argc, char** argv) { return evigrid::driver::run_program(argc, argv); }
