// SPDX-License-Identifier: Apache-2.0
// Competitors taking turns on slices of the same work in one process. A virtual machine's speed drifts by half within
// seconds, so a ratio is formed within a round, where the turns lie milliseconds apart, and its median is reported.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace evigrid::bench {

inline double median(std::vector<double> v) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  const std::size_t n = v.size();
  return n % 2 == 1 ? v[n / 2] : 0.5 * (v[n / 2 - 1] + v[n / 2]);
}

struct Competitor {
  std::string name;
  std::size_t shift;  ///< its slice in round r is (r + shift) mod slices: no one finds what another has just fetched
  std::function<void(std::size_t slice)> prepare;        ///< not timed; may be empty
  std::function<std::uint64_t(std::size_t slice)> turn;  ///< timed; returns the cells it updated
  std::vector<double> seconds{}, cells{};                ///< one entry a round
};

/// Round r: everyone does one slice, the first to go rotating.
inline void play_round(std::vector<Competitor>& all, std::size_t round, std::size_t slices) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    Competitor& c = all[(k + round) % all.size()];
    const std::size_t slice = (round + c.shift) % slices;
    if (c.prepare) c.prepare(slice);
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t cells = c.turn(slice);
    c.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    c.cells.push_back(static_cast<double>(cells));
  }
}

/// Median over rounds of cells per second.
inline double rate(const Competitor& c) {
  std::vector<double> r;
  for (std::size_t i = 0; i < c.seconds.size(); ++i) r.push_back(c.cells[i] / c.seconds[i]);
  return median(r);
}
/// Median over rounds of (cells per second of a) / (cells per second of b).
inline double rate_ratio(const Competitor& a, const Competitor& b) {
  std::vector<double> r;
  for (std::size_t i = 0; i < a.seconds.size(); ++i)
    r.push_back(a.cells[i] / a.seconds[i] / (b.cells[i] / b.seconds[i]));
  return median(r);
}
/// Median over rounds of (seconds of b) / (seconds of a): how many times faster a does the same slice.
inline double speed_ratio(const Competitor& a, const Competitor& b) {
  std::vector<double> r;
  for (std::size_t i = 0; i < a.seconds.size(); ++i) r.push_back(b.seconds[i] / a.seconds[i]);
  return median(r);
}

}  // namespace evigrid::bench
