// SPDX-License-Identifier: Apache-2.0
// Rules for several sources at once, where all together is another result than one after the other. In double, scalar:
// a cell of s sources is a sum over up to 3^s products.
#pragma once
#include <cstddef>

namespace evigrid::kernels {

inline constexpr int kMostJointSources = 8;

enum JointRule : int {
  kJointYager,
  kJointDsmh,
  kJointPcr1,
  kJointPcr2,
  kJointPcr4,
  kJointPcr5,
  kJointPcr6,
  kJointPcr5Plus,
  kJointPcr6Plus
};

/// Masses of one source; c (empty ∩ occupied) may be null.
struct JointSource {
  const double *e, *o, *u, *c;
};
struct JointResult {
  double *e, *o, *u, *k;  // k may be null
};

/// Cells [begin, end) of `count` sources, 1 ≤ count ≤ kMostJointSources.
void joint_double(JointRule, const JointSource* sources, int count, const JointResult&, std::size_t begin,
                  std::size_t end);

}  // namespace evigrid::kernels
