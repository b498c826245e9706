// SPDX-License-Identifier: Apache-2.0
// What a belief says of a set: Bel, Pl, q, BetP, DSmP; Shafer's discount; a decision.
#include <bit>
#include <stdexcept>

#include "evigrid/frame.hpp"

namespace evigrid {
namespace {

template <class Keep>
double sum_where(const Belief& b, const Keep& keep) {
  double sum = 0;
  for (Subset x = 1; x < b.m.size(); ++x) {
    if (keep(x)) sum += b.m[x];
  }
  return sum;
}
double size_of(Subset x) { return std::popcount(x); }

void require_size(const Frame& frame, const Belief& b) {
  if (b.m.size() != frame.subsets()) {
    throw std::invalid_argument("belief: " + std::to_string(b.m.size()) + " masses, the frame has " +
                                std::to_string(frame.subsets()) + " sets");
  }
}

}  // namespace

Belief discount(const Frame& frame, const Belief& b, double reliability) {
  require_size(frame, b);
  if (!(reliability >= 0 && reliability <= 1)) {
    throw std::invalid_argument("reliability: is " + std::to_string(reliability) + ", must be within [0, 1]");
  }
  Belief out = b;
  for (double& m : out.m) m *= reliability;
  out.m[frame.everything()] += 1 - reliability;
  return out;
}

double belief(const Frame& frame, const Belief& b, Subset a) {
  require_size(frame, b);
  return sum_where(b, [&](Subset x) { return (x & ~a) == 0; });
}
double plausibility(const Frame& frame, const Belief& b, Subset a) {
  require_size(frame, b);
  return sum_where(b, [&](Subset x) { return (x & a) != 0; });
}
double commonality(const Frame& frame, const Belief& b, Subset a) {
  require_size(frame, b);
  return sum_where(b, [&](Subset x) { return (x & a) == a; }) + (a == 0 ? b.m[0] : 0);
}

double pignistic(const Frame& frame, const Belief& b, Subset a) {
  require_size(frame, b);
  double p = 0;
  for (Subset x = 1; x < b.m.size(); ++x) p += b.m[x] * (size_of(x & a) / size_of(x));
  const double closed = 1 - b.m[0];
  return closed > 0 ? p / closed : size_of(a) / size_of(frame.everything());
}

double dsmp(const Frame& frame, const Belief& b, Subset a, double epsilon) {
  require_size(frame, b);
  if (frame.everything() != (Subset{1} << frame.size()) - 1) {
    throw std::invalid_argument("dsmp: is for Shafer's model");
  }
  if (!(epsilon > 0)) throw std::invalid_argument("epsilon: must be above 0");
  const auto weight = [&](Subset set) {
    double sum = epsilon * size_of(set);
    for (Subset part = 1; part < b.m.size(); part <<= 1) {
      if ((part & set) != 0) sum += b.m[part];
    }
    return sum;
  };
  double p = 0;
  for (Subset x = 1; x < b.m.size(); ++x) {
    if (b.m[x] != 0 && (x & a) != 0) p += b.m[x] * (weight(x & a) / weight(x));
  }
  return p;
}

std::size_t decide(const Frame& frame, const Belief& b, double least) {
  std::size_t best = frame.size();
  double most = -1;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double p = pignistic(frame, b, frame.hypothesis(i));
    if (p > most) most = p, best = i;
  }
  return most >= least ? best : frame.size();
}

}  // namespace evigrid
