// SPDX-License-Identifier: Apache-2.0
// The rules on a general frame, any number of sources at once: a walk over all tuples of focal elements, one of each
// source; what a tuple's product goes to is the rule.
#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "evigrid/frame.hpp"

namespace evigrid {
namespace {

struct Focal {
  Subset set;
  double mass;
};
using Tuple = std::vector<Focal>;  // one focal element of each source

constexpr double kMostTuples = 1e8;

void require(bool good, const std::string& why) {
  if (!good) throw std::invalid_argument("combine: " + why);
}

/// body(tuple, product, intersection) for every tuple.
template <class Body>
void over_tuples(const std::vector<std::vector<Focal>>& sources, const Body& body) {
  Tuple tuple;
  const auto walk = [&](const auto& self, double product, Subset common) -> void {
    if (tuple.size() == sources.size()) return body(tuple, product, common);
    for (const Focal& f : sources[tuple.size()]) {
      tuple.push_back(f);
      self(self, product * f.mass, common & f.set);
      tuple.pop_back();
    }
  };
  walk(walk, 1, ~Subset{0});
}

/// The sets of a tuple, each once.
std::vector<Subset> distinct(const Tuple& tuple) {
  std::vector<Subset> out;
  for (const Focal& f : tuple) out.push_back(f.set);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}
/// Canonical form: without the sets that contain another of them (Smarandache & Dezert 2006, PCR2 … PCR4).
std::vector<Subset> canonical(const std::vector<Subset>& sets) {
  std::vector<Subset> out;
  for (const Subset x : sets) {
    if (std::none_of(sets.begin(), sets.end(), [&](Subset y) { return y != x && (y & ~x) == 0; })) out.push_back(x);
  }
  return out;
}
/// Without the sets that contain all the others of their size or less (Dezert, Dezert & Smarandache 2021, PCR5+,
/// PCR6+): what is left makes the conflict.
std::vector<Subset> effective(const std::vector<Subset>& sets) {
  std::vector<Subset> out;
  for (const Subset x : sets) {
    bool any = false, all = true;
    for (const Subset y : sets) {
      if (y == x || std::popcount(y) > std::popcount(x)) continue;
      any = true;
      all = all && (y & ~x) == 0;
    }
    if (!any || !all) out.push_back(x);
  }
  return out;
}

/// `mass` to the sets in proportion to weight(set); to `otherwise` where all weights are 0.
template <class Weight>
void share(std::vector<double>& m, double mass, const std::vector<Subset>& sets, const Weight& weight,
           Subset otherwise) {
  double sum = 0;
  for (const Subset x : sets) sum += weight(x);
  if (!(sum > 0)) {
    m[otherwise] += mass;
    return;
  }
  for (const Subset x : sets) m[x] += mass * (weight(x) / sum);
}

class Fusion {
 public:
  Fusion(const Frame& frame, std::span<const Belief> beliefs)
      : frame_(frame), columns_(frame.subsets()), all_(frame.everything()) {
    for (const Belief& b : beliefs) {
      std::vector<Focal> focal;
      for (Subset x = 0; x < b.m.size(); ++x) {
        if (b.m[x] > 0) focal.push_back({x, b.m[x]});
        columns_[x] += b.m[x];
      }
      sources_.push_back(std::move(focal));
    }
    double tuples = 1;
    for (const auto& s : sources_) tuples *= static_cast<double>(s.size());
    require(tuples <= kMostTuples, "more than 10^8 tuples of focal elements");
    conjunctive_.assign(frame.subsets(), 0);
    over_tuples(sources_, [&](const Tuple&, double product, Subset common) { conjunctive_[common] += product; });
    conflict_ = conjunctive_[0];
  }

  [[nodiscard]] double conflict() const { return conflict_; }
  [[nodiscard]] std::vector<double> conjunctive() const { return conjunctive_; }
  [[nodiscard]] std::vector<double> closed() const {  // without what fell on the empty set
    std::vector<double> m = conjunctive_;
    m[0] = 0;
    return m;
  }
  [[nodiscard]] std::vector<double> disjunctive() const {
    std::vector<double> m(frame_.subsets());
    over_tuples(sources_, [&](const Tuple& t, double product, Subset) { m[united(t)] += product; });
    return m;
  }
  [[nodiscard]] std::vector<double> yager() const {
    std::vector<double> m = closed();
    m[all_] += conflict_;
    return m;
  }
  [[nodiscard]] std::vector<double> to_unions() const {
    std::vector<double> m = closed();
    over_conflicts([&](const Tuple& t, double product) { m[united(t)] += product; });
    return m;
  }
  [[nodiscard]] std::vector<double> pcr1() const {
    std::vector<double> m = closed();
    std::vector<Subset> sets;
    for (Subset x = 1; x < m.size(); ++x) {
      if (columns_[x] > 0) sets.push_back(x);
    }
    share(
        m, conflict_, sets, [&](Subset x) { return columns_[x]; }, all_);
    return m;
  }
  [[nodiscard]] std::vector<double> pcr2() const {
    std::vector<double> m = closed();
    std::vector<bool> involved(m.size());
    over_conflicts([&](const Tuple& t, double) {
      for (const Subset x : canonical(distinct(t))) involved[x] = true;
    });
    std::vector<Subset> sets;
    for (Subset x = 1; x < m.size(); ++x) {
      if (involved[x]) sets.push_back(x);
    }
    share(
        m, conflict_, sets, [&](Subset x) { return columns_[x]; }, all_);
    return m;
  }
  [[nodiscard]] std::vector<double> pcr3(bool by_conjunctive) const {
    std::vector<double> m = closed();
    over_conflicts([&](const Tuple& t, double product) {
      const std::vector<Subset> sets = canonical(distinct(t));
      const bool masses =
          by_conjunctive && std::all_of(sets.begin(), sets.end(), [&](Subset x) { return conjunctive_[x] > 0; });
      share(
          m, product, sets, [&](Subset x) { return masses ? conjunctive_[x] : columns_[x]; }, all_);
    });
    return m;
  }
  /// PCR5: by the product of what the sources put on a set; PCR6: by the sum.
  [[nodiscard]] std::vector<double> pcr5(bool by_sum, bool effective_only) const {
    std::vector<double> m = closed();
    over_conflicts([&](const Tuple& t, double product) {
      const auto put = [&](Subset x) {
        double sum = 0, times = 1;
        for (const Focal& f : t) {
          if (f.set == x) sum += f.mass, times *= f.mass;
        }
        return by_sum ? sum : times;
      };
      const std::vector<Subset> sets = distinct(t);
      share(m, product, effective_only ? effective(sets) : sets, put, all_);
    });
    return m;
  }

 private:
  template <class Body>
  void over_conflicts(const Body& body) const {
    over_tuples(sources_, [&](const Tuple& t, double product, Subset common) {
      if (common == 0) body(t, product);
    });
  }
  [[nodiscard]] Subset united(const Tuple& t) const {
    Subset all = 0;
    for (const Focal& f : t) all |= f.set;
    return all;
  }

  const Frame& frame_;
  std::vector<std::vector<Focal>> sources_;
  std::vector<double> columns_, conjunctive_;
  double conflict_ = 0;
  Subset all_;
};

bool divide_by_sum(std::vector<double>& m) {
  double sum = 0;
  for (const double x : m) sum += x;
  if (!(sum > 0)) return false;
  for (double& x : m) x /= sum;
  return true;
}

/// Without what a source holds on the empty set; vacuous when nothing is left.
Belief dropped(const Frame& frame, Belief b) {
  if (b.m[0] == 0) return b;
  b.m[0] = 0;
  return divide_by_sum(b.m) ? b : vacuous(frame);
}

void check(const Frame& frame, std::span<const Belief> sources) {
  require(!sources.empty(), "no source");
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const std::string who = "source " + std::to_string(s + 1) + ": ";
    const auto& m = sources[s].m;
    require(m.size() == frame.subsets(),
            who + std::to_string(m.size()) + " masses, the frame has " + std::to_string(frame.subsets()) + " sets");
    double sum = 0;
    for (Subset x = 0; x < m.size(); ++x) {
      require(m[x] >= 0, who + "the mass of " + frame.text(x) + " is negative or no number");
      require(m[x] == 0 || x == 0 || frame.has(x), who + "a mass on a set that the hyper-power set has not");
      sum += m[x];
    }
    require(std::abs(sum - 1) <= 1e-6, who + "the masses add up to " + std::to_string(sum) + ", not to 1");
  }
}

std::vector<double> by_rule(Rule rule, const Fusion& f) {
  switch (rule) {
    case Rule::conjunctive:
    case Rule::dsmc:
      return f.conjunctive();
    case Rule::disjunctive:
      return f.disjunctive();
    case Rule::dempster:
      return f.closed();
    case Rule::yager:
      return f.yager();
    case Rule::dubois_prade:
    case Rule::dsmh:
      return f.to_unions();
    case Rule::pcr1:
      return f.pcr1();
    case Rule::pcr2:
      return f.pcr2();
    case Rule::pcr3:
      return f.pcr3(false);
    case Rule::pcr4:
      return f.pcr3(true);
    case Rule::pcr5:
      return f.pcr5(false, false);
    case Rule::pcr6:
      return f.pcr5(true, false);
    case Rule::pcr5plus:
      return f.pcr5(false, true);
    case Rule::pcr6plus:
      return f.pcr5(true, true);
    default:
      throw std::invalid_argument("combine: rule " + std::string(name(rule)) + " has no form on general frames");
  }
}

/// Murphy (2000): the mean of s sources with itself, s − 1 times, by Dempster's rule.
Fused murphy(const Frame& frame, const std::vector<Belief>& sources) {
  Belief mean{std::vector<double>(frame.subsets())};
  for (const Belief& b : sources) {
    for (Subset x = 0; x < b.m.size(); ++x) mean.m[x] += b.m[x] / static_cast<double>(sources.size());
  }
  Fused out{mean};
  for (std::size_t i = 1; i < sources.size(); ++i) {
    const Fused next = combine(Rule::dempster, frame, std::vector<Belief>{out.belief, mean});
    out = {next.belief, out.conflict + next.conflict};
  }
  return out;
}

}  // namespace

Fused combine(Rule rule, const Frame& frame, std::span<const Belief> sources) {
  check(frame, sources);
  const bool open = rule == Rule::conjunctive || rule == Rule::dsmc;
  std::vector<Belief> closed(sources.begin(), sources.end());
  if (!open) {
    for (Belief& b : closed) b = dropped(frame, std::move(b));
  }
  if (rule == Rule::murphy) return murphy(frame, closed);
  const Fusion fusion(frame, closed);
  Fused out{{by_rule(rule, fusion)}, fusion.conflict()};
  if (!divide_by_sum(out.belief.m)) out.belief = vacuous(frame), out.total_conflict = true;
  return out;
}

}  // namespace evigrid
