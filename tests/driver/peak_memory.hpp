// SPDX-License-Identifier: Apache-2.0
// How much memory the built program held at most. The kernel counts what this process held before the program took its
// place, so only runs that need more than the test itself tell anything.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <string>
#include <vector>

extern char** environ;

namespace evigrid::driver {

/// MB; what the program prints is dropped.
inline double peak_mb(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), EVIGRID_PROGRAM);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t to_nowhere;
  posix_spawn_file_actions_init(&to_nowhere);
  posix_spawn_file_actions_addopen(&to_nowhere, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawn(&child, EVIGRID_PROGRAM, &to_nowhere, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&to_nowhere);
  EXPECT_EQ(error, 0);
  int status = 0;
  rusage used{};
  EXPECT_EQ(wait4(child, &status, 0, &used), child);
  EXPECT_EQ(status, 0);
  return static_cast<double>(used.ru_maxrss) / 1e3;
}

}  // namespace evigrid::driver
