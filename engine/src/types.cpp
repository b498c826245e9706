// SPDX-License-Identifier: Apache-2.0
// Names of the enumerations, one table each (of rules and models: rule_kernels.cpp, model_rows.cpp), and poses.
#include "evigrid/types.hpp"

#include <array>

#include "evigrid/map.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid {
namespace {

template <class E>
struct Named {
  E value;
  std::string_view name;
};
constexpr auto kKernelNames = std::to_array<Named<Kernel>>({{Kernel::automatic, "auto"},
                                                            {Kernel::scalar, "scalar"},
                                                            {Kernel::avx2, "avx2"},
                                                            {Kernel::avx512, "avx512"},
                                                            {Kernel::cuda, "cuda"}});
constexpr auto kLikelihoodNames =
    std::to_array<Named<Likelihood>>({{Likelihood::betp, "betp"}, {Likelihood::plp, "plp"}});
constexpr auto kDependenceNames = std::to_array<Named<Dependence>>({{Dependence::independent, "independent"},
                                                                    {Dependence::cautious, "cautious"},
                                                                    {Dependence::once_per_scan, "once_per_scan"},
                                                                    {Dependence::weighted, "weighted"}});
constexpr auto kRefusalNames = std::to_array<Named<Refusal>>({{Refusal::not_a_number, "not_a_number"},
                                                              {Refusal::too_close, "too_close"},
                                                              {Refusal::negative, "negative"},
                                                              {Refusal::no_return, "no_return"},
                                                              {Refusal::above_max_range, "above_max_range"},
                                                              {Refusal::wrong_beam_count, "wrong_beam_count"},
                                                              {Refusal::unknown_sensor, "unknown_sensor"},
                                                              {Refusal::pose_not_finite, "pose_not_finite"},
                                                              {Refusal::false_reflection, "false_reflection"}});
static_assert(kRefusalNames.size() == kRefusalCount);

template <class Table, class E>
std::string_view find_name(const Table& table, E value) noexcept {
  for (const auto& n : table) {
    if (n.value == value) return n.name;
  }
  return "?";
}
template <class E, class Table>
std::optional<E> find_value(const Table& table, std::string_view text) noexcept {
  for (const auto& n : table) {
    if (n.name == text) return n.value;
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(Kernel k) noexcept { return find_name(kKernelNames, k); }
std::string_view name(Likelihood l) noexcept { return find_name(kLikelihoodNames, l); }
std::string_view name(Refusal r) noexcept { return find_name(kRefusalNames, r); }
std::optional<Likelihood> likelihood_from_name(std::string_view s) noexcept {
  return find_value<Likelihood>(kLikelihoodNames, s);
}
std::string_view name(Dependence d) noexcept { return find_name(kDependenceNames, d); }
std::optional<Dependence> dependence_from_name(std::string_view s) noexcept {
  return find_value<Dependence>(kDependenceNames, s);
}
std::optional<Kernel> kernel_from_name(std::string_view s) noexcept { return find_value<Kernel>(kKernelNames, s); }

Pose2 compose(const Pose2& a, const Pose2& b) noexcept {
  const kernels::SinCos sc = kernels::portable_sincos(a.yaw_rad);
  return {a.x_m + (sc.cos * b.x_m - sc.sin * b.y_m), a.y_m + (sc.sin * b.x_m + sc.cos * b.y_m), a.yaw_rad + b.yaw_rad};
}

}  // namespace evigrid
