// SPDX-License-Identifier: Apache-2.0
// Joint forms over arrays: blocks of cells over the executor.
#include "evigrid/joint.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "kernels/row/joint.hpp"

namespace evigrid {
namespace {

static_assert(kMostJointSources == kernels::kMostJointSources);

std::optional<kernels::JointRule> joint_of(Rule rule) noexcept {
  switch (rule) {
    case Rule::yager:
    case Rule::dubois_prade:
      return kernels::kJointYager;
    case Rule::dsmh:
      return kernels::kJointDsmh;
    case Rule::pcr1:
      return kernels::kJointPcr1;
    case Rule::pcr2:
    case Rule::pcr3:
      return kernels::kJointPcr2;
    case Rule::pcr4:
      return kernels::kJointPcr4;
    case Rule::pcr5:
      return kernels::kJointPcr5;
    case Rule::pcr6:
      return kernels::kJointPcr6;
    case Rule::pcr5plus:
      return kernels::kJointPcr5Plus;
    case Rule::pcr6plus:
      return kernels::kJointPcr6Plus;
    default:
      return std::nullopt;
  }
}

kernels::JointRule checked(Rule rule, std::size_t sources) {
  const auto joint = joint_of(rule);
  if (!joint) throw std::invalid_argument("rule: " + std::string(name(rule)) + " has no joint form");
  if (sources < 1 || sources > static_cast<std::size_t>(kMostJointSources)) {
    throw std::invalid_argument("sources: " + std::to_string(sources) + ", must be 1 to " +
                                std::to_string(kMostJointSources));
  }
  return *joint;
}

constexpr std::size_t kBlock = 512;  // cells of a task, and of the copies in double

template <class Body>
void over_blocks(std::size_t n, Executor* executor, const Body& body) {
  const auto blocks = static_cast<std::int64_t>((n + kBlock - 1) / kBlock);
  struct Context {
    const Body& body;
    std::size_t n;
  } context{body, n};
  const auto task = [](void* p, std::int64_t index, int) {
    const auto& c = *static_cast<const Context*>(p);
    const std::size_t begin = static_cast<std::size_t>(index) * kBlock;
    c.body(begin, std::min(begin + kBlock, c.n));
  };
  if (executor != nullptr && blocks > 1) return executor->run(blocks, task, &context);
  for (std::int64_t i = 0; i < blocks; ++i) task(&context, i, 0);
}

}  // namespace

bool has_joint_form(Rule rule) noexcept { return joint_of(rule).has_value(); }

void combine_joint(Rule rule, std::span<const Planes<const double>> sources, Planes<double> c, double* conflict,
                   std::size_t n, Executor* executor) {
  const kernels::JointRule joint = checked(rule, sources.size());
  std::array<kernels::JointSource, kMostJointSources> from{};
  for (std::size_t s = 0; s < sources.size(); ++s) from[s] = {sources[s].e, sources[s].o, sources[s].u, sources[s].c};
  over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    kernels::joint_double(joint, from.data(), static_cast<int>(sources.size()), {c.e, c.o, c.u, conflict}, begin, end);
    if (c.c != nullptr) std::fill(c.c + begin, c.c + end, 0.0);
  });
}

void combine_joint(Rule rule, std::span<const Planes<const float>> sources, Planes<float> c, float* conflict,
                   std::size_t n, Executor* executor) {
  const kernels::JointRule joint = checked(rule, sources.size());
  over_blocks(n, executor, [&](std::size_t begin, std::size_t end) {
    double in[kMostJointSources][4][kBlock], out[4][kBlock];
    std::array<kernels::JointSource, kMostJointSources> from{};
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const float* const planes[4] = {sources[s].e, sources[s].o, sources[s].u, sources[s].c};
      for (std::size_t p = 0; p < 4; ++p) {
        if (planes[p] != nullptr) std::copy(planes[p] + begin, planes[p] + end, in[s][p]);
      }
      from[s] = {in[s][0], in[s][1], in[s][2], sources[s].c != nullptr ? in[s][3] : nullptr};
    }
    kernels::joint_double(joint, from.data(), static_cast<int>(sources.size()), {out[0], out[1], out[2], out[3]}, 0,
                          end - begin);
    float* const to[4] = {c.e, c.o, c.u, conflict};
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t i = begin; i < end && to[p] != nullptr; ++i) to[p][i] = static_cast<float>(out[p][i - begin]);
    }
    if (c.c != nullptr) std::fill(c.c + begin, c.c + end, 0.0f);
  });
}

}  // namespace evigrid
