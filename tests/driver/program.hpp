// SPDX-License-Identifier: Apache-2.0
// The built program, called as a user calls it.
#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "temp_dir.hpp"

namespace evigrid::driver {

struct Ran {
  int code = -1;
  std::string out, err;
};

/// Runs EVIGRID_PROGRAM with the arguments; `input` becomes its standard input.
inline Ran evigrid(const std::vector<std::string>& arguments, const std::string& input = "") {
  const TempDir streams;
  std::string command = "'" EVIGRID_PROGRAM "'";
  for (const std::string& argument : arguments) {
    std::string quoted;
    for (const char c : argument) {
      if (c == '\'') quoted += "'\\'";
      quoted.push_back(c);
    }
    command += " '" + quoted + "'";
  }
  streams.write("in", input);
  command += " <'" + streams.at("in") + "' >'" + streams.at("out") + "' 2>'" + streams.at("err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, slurp(streams.at("out")), slurp(streams.at("err"))};
}

}  // namespace evigrid::driver
