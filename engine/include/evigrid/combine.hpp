// SPDX-License-Identifier: Apache-2.0
// Batched combination over arrays: n independent cells, A ⊕= B and A ⊕ B → C, for every rule, in float (all kernels)
// and in double (scalar). Arrays are planes: e[i], o[i], u[i] are the masses of cell i, c[i] where it is there its mass
// on empty ∩ occupied (m(∅) in the open world); they add up to 1.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "evigrid/executor.hpp"
#include "evigrid/types.hpp"

namespace evigrid {

template <class T>
struct Planes {
  T* e = nullptr;
  T* o = nullptr;
  T* u = nullptr;
  T* c = nullptr;  ///< may be null
};

/// C = A ⊕ B; C may be A (in place). `conflict` (may be null) receives k of each pair. Without an executor it runs on
/// the calling thread. Returns how many pairs were in total conflict: Dempster answers those with the vacuous mass. No
/// floor is applied: exact inputs give the exact rule. Throws std::invalid_argument for a kernel that cannot run.
/// c of A and B, none when null: conjunctive and dsmc keep it, dsmh and germ_pcr2 consume it, the PCR family gives it
/// back to e and o, the others drop it (fuzzy: ignores it). c of C receives it, 0 where the rule leaves none. Pairs
/// with a c are combined in double and rounded, by any kernel. What the masses are to bayes and fuzzy: docs/maths.md.
std::uint64_t combine(Rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                      std::size_t n, Kernel = Kernel::automatic, Executor* = nullptr);
std::uint64_t combine(Rule, Planes<const double> a, Planes<const double> b, Planes<double> c, double* conflict,
                      std::size_t n, Executor* = nullptr);

/// Kernels compiled in that this processor can run, widest last; and the one `automatic` takes.
std::string_view resolve_kernel_name(Kernel);
bool kernel_available(Kernel) noexcept;

/// Membership in "occupied for planning" of chapter 14, eq. 14.18, from those of empty and of occupied:
/// 1 − Ψ²(1 − Ω)(1 − ΨΩ)(1 − (1 − Ψ)(1 − Ω)). Never seen is 1.
[[nodiscard]] double fuzzy_map(double empty, double occupied) noexcept;

}  // namespace evigrid
