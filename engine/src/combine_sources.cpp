// SPDX-License-Identifier: Apache-2.0
// Several sources in one pass over memory: a block of cells stays in the nearest cache while source after source is
// combined into it, so that each source is read once and the result written once.
#include <algorithm>
#include <stdexcept>

#include "combine_blocks.hpp"

namespace evigrid {
namespace {

constexpr std::size_t kResident = 1024;  // cells: their state is 12 KB in float, 24 KB in double

template <class T>
Planes<T> from(Planes<T> p, std::size_t at) {
  return {p.e + at, p.o + at, p.u + at, p.c != nullptr ? p.c + at : nullptr};
}
template <class T>
Planes<const T> read(Planes<T> p) {
  return {p.e, p.o, p.u, p.c};
}

/// One resident block, cells [0, n): `two` is the combination of two sources on it.
template <class T, class Two>
struct Resident {
  const Two& two;
  Rule rule;
  std::size_t n;
  T* conflict;  // may be null; the sum over the steps
  std::uint64_t totals = 0;
  T k[kResident];  // of one step

  Resident(const Two& of_two, Rule by, std::size_t cells, T* sum) : two(of_two), rule(by), n(cells), conflict(sum) {}

  void step(Rule by, Planes<const T> a, Planes<const T> b, Planes<T> c, bool first) {
    T* const to = conflict == nullptr ? nullptr : first ? conflict : k;
    totals += two(by, a, b, c, to, n);
    if (to == k) {
      for (std::size_t i = 0; i < n; ++i) conflict[i] += k[i];
    }
  }

  void in_order(std::span<const Planes<const T>> sources, std::size_t at, Planes<T> c) {
    T paradox[kResident];
    Planes<T> state{c.e, c.o, c.u, nullptr};
    if (keeps_paradox(rule)) state.c = c.c != nullptr ? c.c : paradox;
    Planes<const T> so_far = from(sources[0], at);
    for (std::size_t s = 1; s < sources.size(); ++s) {
      step(rule, so_far, from(sources[s], at), state, s == 1);
      so_far = read(state);
    }
  }

  /// Murphy (2000): the mean of the sources with itself, once less than there are sources, by Dempster's rule.
  void mean(std::span<const Planes<const T>> sources, std::size_t at, Planes<T> c) {
    T mean_e[kResident] = {}, mean_o[kResident] = {}, mean_u[kResident] = {}, one_e[kResident], one_o[kResident],
      one_u[kResident];
    const T zero[kResident] = {};
    T all[kResident];
    std::fill_n(all, n, T{1});
    const T share = T{1} / static_cast<T>(sources.size());
    for (const Planes<const T>& source : sources) {
      Planes<const T> one = from(source, at);
      if (one.c != nullptr) {  // dropped: a vacuous partner leaves the rest, divided by its sum
        two(Rule::dempster, one, {zero, zero, all}, {one_e, one_o, one_u}, nullptr, n);
        one = {one_e, one_o, one_u};
      }
      for (std::size_t i = 0; i < n; ++i) {
        mean_e[i] += one.e[i] * share;
        mean_o[i] += one.o[i] * share;
        mean_u[i] += one.u[i] * share;
      }
    }
    Planes<const T> so_far{mean_e, mean_o, mean_u};
    for (std::size_t s = 1; s < sources.size(); ++s) {
      step(Rule::dempster, so_far, {mean_e, mean_o, mean_u}, {c.e, c.o, c.u}, s == 1);
      so_far = {c.e, c.o, c.u};
    }
  }
};

template <class T, class Two>
std::uint64_t one_pass(Rule rule, std::span<const Planes<const T>> sources, Planes<T> c, T* conflict, std::size_t n,
                       Executor* executor, const Two& two) {
  if (sources.size() < 2) throw std::invalid_argument("sources: at least two are combined");
  return over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    std::uint64_t totals = 0;
    for (std::size_t at = begin; at < end; at += kResident) {
      Resident<T, Two> block(two, rule, std::min(kResident, end - at), conflict != nullptr ? conflict + at : nullptr);
      if (rule == Rule::murphy && sources.size() > 2) {
        block.mean(sources, at, from(c, at));
      } else {
        block.in_order(sources, at, from(c, at));
      }
      totals += block.totals;
      if (c.c != nullptr && !keeps_paradox(rule)) std::fill_n(c.c + at, block.n, T{0});
    }
    return totals;
  });
}

}  // namespace

std::uint64_t combine(Rule rule, std::span<const Planes<const float>> sources, Planes<float> c, float* conflict,
                      std::size_t n, Kernel kernel, Executor* executor) {
  const kernels::KernelTable& table = table_of(kernel);
  const auto two = [&](Rule by, Planes<const float> a, Planes<const float> b, Planes<float> to, float* k,
                       std::size_t cells) { return combine_range(table, by, a, b, to, k, 0, cells); };
  return one_pass(rule, sources, c, conflict, n, executor, two);
}

std::uint64_t combine(Rule rule, std::span<const Planes<const double>> sources, Planes<double> c, double* conflict,
                      std::size_t n, Executor* executor) {
  const auto two = [&](Rule by, Planes<const double> a, Planes<const double> b, Planes<double> to, double* k,
                       std::size_t cells) { return combine_range(by, a, b, to, k, 0, cells); };
  return one_pass(rule, sources, c, conflict, n, executor, two);
}

}  // namespace evigrid
