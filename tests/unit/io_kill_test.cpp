// SPDX-License-Identifier: Apache-2.0
// kill -9 of a program that saves: what lies under the name is the old map or the new one, whole.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "equivalence/random_scans.hpp"
#include "evigrid/io.hpp"
#include "temp_folder.hpp"

namespace evigrid {
namespace {

constexpr int kKills = 60;

Map driven(const testing::Drive& drive, std::size_t scans) {
  Map map({.cell_m = 0.02}, make_serial_executor());
  for (const Sensor& s : drive.sensors) map.add(s);
  map.integrate(std::span(drive.scans).first(scans));
  return map;
}

std::string bytes_of(const Map& map) {
  std::ostringstream out;
  save(map, out);
  return out.str();
}

std::string slurp(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Saves one map, then the other, over the same file, for ever; a byte into the pipe when the first save is under way.
[[noreturn]] void save_for_ever(const Map& a, const Map& b, const std::string& file, int started) {
  (void)!::write(started, "s", 1);
  for (;;) {
    save(a, file);
    save(b, file);
  }
}

TEST(KilledWhileSaving, LeavesTheOldMapOrTheNewOne) {
  const auto drive = testing::drive(Model::li2014, 40, 5);
  const Map first = driven(*drive, 20), second = driven(*drive, 40);
  const std::string bytes[2]{bytes_of(first), bytes_of(second)};
  ASSERT_NE(bytes[0], bytes[1]);
  const TempFolder folder;
  const std::string file = folder.at("map.evigrid");
  save(first, file);
  const auto begin = std::chrono::steady_clock::now();
  save(first, file);
  const double save_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
  std::mt19937 rng(11);
  int cut_short = 0, seen[2]{};
  for (int kill = 0; kill < kKills; ++kill) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();  // serial maps: the child needs no thread of ours
    ASSERT_GE(child, 0);
    if (child == 0) save_for_ever(first, second, file, ready[1]);
    ::close(ready[1]);
    char s = 0;
    ASSERT_EQ(::read(ready[0], &s, 1), 1);
    ::close(ready[0]);
    const double wait_us = std::uniform_real_distribution<double>(0, 3 * save_us)(rng);
    std::this_thread::sleep_for(std::chrono::duration<double, std::micro>(wait_us));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "ended by itself: " << status;

    const std::string now = slurp(file);
    ASSERT_TRUE(now == bytes[0] || now == bytes[1]) << "after kill " << kill;
    ++seen[now == bytes[1]];
    const std::uint64_t hash = load(file).hash();
    ASSERT_TRUE(hash == first.hash() || hash == second.hash());
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      if (entry.path() == file) continue;
      ++cut_short;  // what it was writing, under a name of its own
      std::filesystem::remove(entry.path());
    }
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
  EXPECT_GE(cut_short, kKills / 4) << "the kills must meet saves half done";
}

}  // namespace
}  // namespace evigrid
