// SPDX-License-Identifier: Apache-2.0
// Batched combination over arrays: n independent cells, A ⊕= B and A ⊕ B → C, for every rule, in float (all kernels)
// and in double (scalar). Arrays are planes: e[i], o[i], u[i] are the masses of cell i, c[i] where it is there its mass
// on empty ∩ occupied (m(∅) in the open world); they add up to 1.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "evigrid/executor.hpp"
#include "evigrid/export.hpp"
#include "evigrid/types.hpp"

namespace EVIGRID_API evigrid {

template <class T>
struct Planes {
  T* e = nullptr;
  T* o = nullptr;
  T* u = nullptr;
  T* c = nullptr;  ///< may be null
};

/// C = A ⊕ B; C may be A (in place). `conflict` (may be null) receives k of each pair. Without an executor it runs on
/// the calling thread. Returns how many pairs were in total conflict: Dempster answers those with the vacuous mass. No
/// floor is applied: exact inputs give the exact rule. Throws std::invalid_argument for a kernel that cannot run, and
/// std::runtime_error when a GPU fails (Kernel::cuda). Masses are not checked.
/// c of A and B, none when null: conjunctive and dsmc keep it, dsmh and germ_pcr2 consume it, the PCR family gives it
/// back to e and o, the others drop it (fuzzy: ignores it). c of C receives it, 0 where the rule leaves none. Pairs
/// with a c are combined in double and rounded, by any kernel. What the masses are to bayes and fuzzy: docs/maths.md.
std::uint64_t combine(Rule, Planes<const float> a, Planes<const float> b, Planes<float> c, float* conflict,
                      std::size_t n, Kernel = Kernel::automatic, Executor* = nullptr);
std::uint64_t combine(Rule, Planes<const double> a, Planes<const double> b, Planes<double> c, double* conflict,
                      std::size_t n, Executor* = nullptr);

/// Two or more sources, one after the other in their order, in one pass over memory: the bits of the calls above, one
/// for each source after the first, without the memory traffic between them. C may be the first source. `conflict` is
/// the sum over the steps; returned is the number of steps in total conflict. Mass on empty ∩ occupied that a rule
/// leaves goes on into the next step, whether C keeps it or not. murphy takes the mean of all s sources and combines
/// it s − 1 times by Dempster's rule. Throws std::invalid_argument for fewer than two sources and a kernel that cannot
/// run.
std::uint64_t combine(Rule, std::span<const Planes<const float>> sources, Planes<float> c, float* conflict,
                      std::size_t n, Kernel = Kernel::automatic, Executor* = nullptr);
std::uint64_t combine(Rule, std::span<const Planes<const double>> sources, Planes<double> c, double* conflict,
                      std::size_t n, Executor* = nullptr);

/// Masses at 16 bits (unorm16), a third of the memory: e[i] and o[i] in steps of 1/65535, the unknown is the rest, 0
/// when rounding took e + o above 1. For large arrays whose masses need no more than four decimals; docs/maths.md says
/// what each rule makes of the rounding.
template <class T>
struct Unorm16Planes {
  T* e = nullptr;
  T* o = nullptr;
};

/// C = A ⊕ B on such arrays: computed in float, rounded to the nearest step, ties to even; the same bits on every
/// kernel. Throws std::invalid_argument too for conjunctive and dsmc, whose results are no masses of e, o, u alone.
/// fuzzy: e and o are the memberships, the rest means nothing.
std::uint64_t combine(Rule, Unorm16Planes<const std::uint16_t> a, Unorm16Planes<const std::uint16_t> b,
                      Unorm16Planes<std::uint16_t> c, float* conflict, std::size_t n, Kernel = Kernel::automatic,
                      Executor* = nullptr);
/// Rounds e and o (within [0, 1]) to the nearest step; u is dropped.
void to_unorm16(Planes<const float> from, Unorm16Planes<std::uint16_t> to, std::size_t n) noexcept;
/// As the kernels read them. c, where `to` has it, is left alone.
void from_unorm16(Unorm16Planes<const std::uint16_t> from, Planes<float> to, std::size_t n) noexcept;

/// What really runs: for `automatic` the widest kernel compiled in that this processor can run. Throws
/// std::invalid_argument for one that it cannot (but not for cuda, which is answered as it is).
std::string_view resolve_kernel_name(Kernel);
/// Whether it is compiled in and runs here.
bool kernel_available(Kernel) noexcept;
/// Empty when Kernel::cuda is available, else why not.
std::string why_no_cuda();

/// Membership in "occupied for planning" (Oriolo et al. 1997; Li, Huang & Dezert 2006, eq. 14.18), from those of empty
/// and of occupied: 1 − Ψ²(1 − Ω)(1 − ΨΩ)(1 − (1 − Ψ)(1 − Ω)). Never seen is 1.
[[nodiscard]] double fuzzy_map(double empty, double occupied) noexcept;

}  // namespace evigrid
