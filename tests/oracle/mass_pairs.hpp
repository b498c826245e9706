// SPDX-License-Identifier: Apache-2.0
// Input of the combination tests: pairs of masses as planes, random (a fifth with zeros and certain contradictions) or
// all pairs of a list of corner cases, and what exact rationals answer for them.
#pragma once
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "evigrid/combine.hpp"
#include "tests/oracle/set_rules.hpp"

namespace oracle {

template <class T>
struct MassArray {
  std::vector<T> e, o, u, c;  // c may stay empty
  explicit MassArray(std::size_t n = 0, bool with_c = false) : e(n), o(n), u(n), c(with_c ? n : 0) {}
  void push(T me, T mo, T mu) { e.push_back(me), o.push_back(mo), u.push_back(mu); }
  [[nodiscard]] std::size_t size() const { return e.size(); }
  evigrid::Planes<T> planes() { return {e.data(), o.data(), u.data(), c.empty() ? nullptr : c.data()}; }
  [[nodiscard]] evigrid::Planes<const T> view() const {
    return {e.data(), o.data(), u.data(), c.empty() ? nullptr : c.data()};
  }
  friend bool operator==(const MassArray&, const MassArray&) = default;
};

template <class T>
struct Pairs {
  MassArray<T> a, b;
  [[nodiscard]] std::size_t size() const { return a.size(); }
};

/// (e, o, 1 − e − o), u rounded to T once and never below 0.
template <class T>
void push_normalised(MassArray<T>& out, T e, T o) {
  const long double rest = 1.0L - static_cast<long double>(e) - static_cast<long double>(o);
  out.push(e, o, static_cast<T>(std::max(rest, 0.0L)));
}

/// Uniform on the simplex of masses.
template <class T, class Engine>
void push_uniform(MassArray<T>& out, Engine& engine) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double s = unit(engine), t = unit(engine);
  push_normalised(out, static_cast<T>(std::min(s, t)), static_cast<T>(std::max(s, t) - std::min(s, t)));
}

/// One mass with zeros, certain, one-sided or tiny.
template <class T, class Engine>
void push_special(MassArray<T>& out, Engine& engine) {
  std::uniform_real_distribution<double> unit(0, 1);
  const T s = static_cast<T>(unit(engine));
  const T tiny = static_cast<T>(std::pow(10.0, -6 - 25 * unit(engine)));
  switch (engine() % 8) {
    case 0:
      return out.push(1, 0, 0);
    case 1:
      return out.push(0, 1, 0);
    case 2:
      return out.push(0, 0, 1);
    case 3:
      return push_normalised(out, s, T(0));
    case 4:
      return push_normalised(out, T(0), s);
    case 5:
      return push_normalised(out, s, static_cast<T>(T(1) - s));
    case 6:
      return push_normalised(out, tiny, s);
    default:
      return push_normalised(out, s, tiny);
  }
}

template <class T>
Pairs<T> random_pairs(std::size_t n, unsigned seed) {
  std::mt19937_64 engine(seed);
  Pairs<T> out;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 5 != 0) {
      push_uniform(out.a, engine);
      push_uniform(out.b, engine);
    } else if (i % 20 == 0) {  // a certain contradiction, either way round
      const bool flip = engine() % 2 == 0;
      out.a.push(flip ? 1 : 0, flip ? 0 : 1, 0);
      out.b.push(flip ? 0 : 1, flip ? 1 : 0, 0);
    } else {
      push_special(out.a, engine);
      push_special(out.b, engine);
    }
  }
  return out;
}

/// All pairs of vacuous, certain, even, tiny and denormal masses.
template <class T>
Pairs<T> corner_pairs() {
  using Limits = std::numeric_limits<T>;
  MassArray<T> corner;
  corner.push(0, 0, 1), corner.push(1, 0, 0), corner.push(0, 1, 0);
  corner.push(T(0.5), T(0.5), 0), corner.push(T(0.5), 0, T(0.5)), corner.push(0, T(0.5), T(0.5));
  for (T tiny : {Limits::epsilon(), T(1e-12), T(1e-30), Limits::min(), Limits::denorm_min(), T(Limits::min() / 16)}) {
    corner.push(tiny, 0, 1), corner.push(0, tiny, 1), corner.push(tiny, 1, 0), corner.push(1, tiny, 0);
    corner.push(1, 0, tiny), corner.push(0, 1, tiny), corner.push(tiny, tiny, 1), corner.push(T(0.5), T(0.5), tiny);
  }
  Pairs<T> out;
  for (std::size_t i = 0; i < corner.size(); ++i)
    for (std::size_t j = 0; j < corner.size(); ++j) {
      out.a.push(corner.e[i], corner.o[i], corner.u[i]);
      out.b.push(corner.e[j], corner.o[j], corner.u[j]);
    }
  return out;
}

/// The same with a mass on empty ∩ occupied: a power of two of each mass moves there, so that sums stay as exact as
/// they were; now and then all of it, or none.
template <class T>
Pairs<T> open_pairs(std::size_t n, unsigned seed) {
  Pairs<T> out = random_pairs<T>(n, seed);
  std::mt19937_64 engine(seed + 1);
  for (MassArray<T>* m : {&out.a, &out.b})
    for (std::size_t i = 0; i < n; ++i) {
      const auto kind = engine() % 16;
      const T left = kind == 0 ? T(0) : kind < 4 ? T(1) : kind < 8 ? T(0.5) : kind < 12 ? T(0.75) : T(0.25);
      const T c = (T(1) - left) * (m->e[i] + m->o[i] + m->u[i]);
      m->e[i] *= left, m->o[i] *= left, m->u[i] *= left;
      m->c.push_back(c);
    }
  return out;
}

/// What exact arithmetic answers, rounded to long double at the very end.
struct Exact {
  std::vector<std::array<long double, 5>> eouck;
  std::uint64_t total_conflicts = 0;
};

inline long double to_long_double(const mpq_class& q) {
  const double high = q.get_d();
  const mpq_class rest = q - mpq_class(high);
  return static_cast<long double>(high) + static_cast<long double>(rest.get_d());
}

template <class T>
Exact exact_results(evigrid::Rule rule, const Pairs<T>& pairs) {
  Exact out;
  out.eouck.reserve(pairs.size());
  const auto belief = [](const MassArray<T>& m, std::size_t i) {
    Belief<mpq_class, 3> b;
    b[kEmpty] = static_cast<double>(m.e[i]);
    b[kOccupied] = static_cast<double>(m.o[i]);
    b[kUnknown] = static_cast<double>(m.u[i]);
    b[kBoth] = m.c.empty() ? 0.0 : static_cast<double>(m.c[i]);
    return b;
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto r = combine<mpq_class, 3>(rule, cell_frame(), belief(pairs.a, i), belief(pairs.b, i));
    out.eouck.push_back({to_long_double(r.m[kEmpty]), to_long_double(r.m[kOccupied]), to_long_double(r.m[kUnknown]),
                         to_long_double(r.m[kBoth]), to_long_double(r.conflict)});
    if (r.total_conflict) ++out.total_conflicts;
  }
  return out;
}

/// The kernels of this processor, by name.
inline std::vector<evigrid::Kernel> available_kernels() {
  std::vector<evigrid::Kernel> out;
  for (auto kernel : {evigrid::Kernel::scalar, evigrid::Kernel::avx2, evigrid::Kernel::avx512})
    if (evigrid::kernel_available(kernel)) out.push_back(kernel);
  return out;
}

}  // namespace oracle
