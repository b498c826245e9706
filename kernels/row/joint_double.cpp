// SPDX-License-Identifier: Apache-2.0
// The joint forms on the frame of a cell. Sums of positive products only, so nothing cancels. A product of one mass of
// each source conflicts when both hypotheses are in it; what it goes to:
//   Yager, Dubois & Prade   ignorance (the union of the sets is that, too)
//   PCR1                    all conflict together, by the column sums of empty, occupied and unknown
//   PCR2 = PCR3             the same without unknown, which excludes nothing
//   PCR4                    by the conjunctive masses of empty and occupied, by the columns where one of those is 0
//   PCR5, PCR6              each product to what it is made of, unknown too, by the product (PCR5) or the sum (PCR6) of
//                           the masses put on it (Smarandache & Dezert 2006; Martin & Osswald 2006)
//   PCR5+, PCR6+            the same without unknown (Dezert, Dezert & Smarandache 2021)
// A mass on empty ∩ occupied is given back first (PCR) or dropped; DSmH takes it as a set of its own.
#include "kernels/row/joint.hpp"

namespace evigrid::kernels {
namespace {

struct Masses {
  double e, o, u, c;
};

Masses given_back(const Masses& m) {
  const double p = m.e + m.o;
  if (p > 0) return {m.e + m.c * (m.e / p), m.o + m.c * (m.o / p), m.u, 0};
  return {0.5 * m.c, 0.5 * m.c, m.u, 0};
}
Masses dropped(const Masses& m) {
  if (m.c == 0) return m;
  const double s = (m.e + m.o) + m.u;
  return s > 0 ? Masses{m.e / s, m.o / s, m.u / s, 0} : Masses{0, 0, 1, 0};
}

/// Sums over all sources: conjunctive masses, conflict, columns.
struct Sums {
  double e = 0, o = 0, t = 1, k = 0;  // of closed sources
  double column_e = 0, column_o = 0, column_u = 0;

  void add(const Masses& m) {
    k = k * ((m.e + m.o) + m.u) + (e * m.o + o * m.e);
    e = e * (m.e + m.u) + t * m.e;
    o = o * (m.o + m.u) + t * m.o;
    t *= m.u;
    column_e += m.e, column_o += m.o, column_u += m.u;
  }
};

struct Shares {
  double e = 0, o = 0, u = 0;
};

/// The conflict as a whole by three weights; to unknown when all are 0 (then there is no conflict either).
Shares by_weights(double k, double e, double o, double u) {
  const double sum = (e + o) + u;
  return sum > 0 ? Shares{k * (e / sum), k * (o / sum), k * (u / sum)} : Shares{0, 0, k};
}

/// One product after the other. `times` or `sum` of what a part was given, none where nothing was.
template <bool kBySum, bool kUnknownToo>
class EachProduct {
 public:
  EachProduct(const Masses* m, int count) : m_(m), count_(count) { walk(0, 1, {}, {}, {}); }
  Shares shares;

 private:
  struct Part {
    bool there = false;
    double put = 0;
    [[nodiscard]] Part with(double mass) const {
      if (!there) return {true, mass};
      return {true, kBySum ? put + mass : put * mass};
    }
  };
  void walk(int source, double product, const Part& e, const Part& o, const Part& u) {
    if (product == 0) return;
    if (source == count_) {
      if (!e.there || !o.there) return;
      const double unknown = kUnknownToo && u.there ? u.put : 0, sum = (e.put + o.put) + unknown;
      if (!(sum > 0)) return;
      shares.e += product * (e.put / sum);
      shares.o += product * (o.put / sum);
      shares.u += product * (unknown / sum);
      return;
    }
    const Masses& m = m_[source];
    walk(source + 1, product * m.e, e.with(m.e), o, u);
    walk(source + 1, product * m.o, e, o.with(m.o), u);
    walk(source + 1, product * m.u, e, o, u.with(m.u));
  }
  const Masses* m_;
  int count_;
};

/// DSmH: a product that holds the paradox, or both hypotheses, goes to the union of its sets; the paradox adds nothing
/// to a union, and alone it stands for ignorance. With a set of letters seen so far as the state: 1 empty, 2 occupied,
/// 4 unknown, 8 paradox.
struct DsmhCell {
  double e, o, t, k;
};
DsmhCell dsmh(const Masses* m, int count) {
  double seen[16] = {1};
  for (int s = 0; s < count; ++s) {
    double next[16] = {};
    for (unsigned set = 0; set < 16; ++set) {
      if (seen[set] == 0) continue;
      next[set | 1] += seen[set] * m[s].e;
      next[set | 2] += seen[set] * m[s].o;
      next[set | 4] += seen[set] * m[s].u;
      next[set | 8] += seen[set] * m[s].c;
    }
    for (unsigned set = 0; set < 16; ++set) seen[set] = next[set];
  }
  DsmhCell out{0, 0, 0, 0};
  for (unsigned set = 1; set < 16; ++set) {
    const bool empty = (set & 8) != 0 || (set & 3) == 3;
    if (empty) out.k += seen[set];
    const unsigned hypotheses = set & 3;
    const bool unknown_matters = empty && (set & 4) != 0;  // in a union; in an intersection it does not
    if (hypotheses == 1 && !unknown_matters) {
      out.e += seen[set];
    } else if (hypotheses == 2 && !unknown_matters) {
      out.o += seen[set];
    } else {
      out.t += seen[set];
    }
  }
  return out;
}

DsmhCell joint_cell(JointRule rule, Masses* m, int count) {
  if (rule == kJointDsmh) return dsmh(m, count);
  Sums q;
  for (int s = 0; s < count; ++s) {
    m[s] = rule == kJointYager ? dropped(m[s]) : given_back(m[s]);
    q.add(m[s]);
  }
  Shares back;
  switch (rule) {
    case kJointYager:
    case kJointDsmh:
      back.u = q.k;
      break;
    case kJointPcr1:
      back = by_weights(q.k, q.column_e, q.column_o, q.column_u);
      break;
    case kJointPcr2:
      back = by_weights(q.k, q.column_e, q.column_o, 0);
      break;
    case kJointPcr4:
      back = q.e > 0 && q.o > 0 ? by_weights(q.k, q.e, q.o, 0) : by_weights(q.k, q.column_e, q.column_o, 0);
      break;
    case kJointPcr5:
      back = EachProduct<false, true>(m, count).shares;
      break;
    case kJointPcr6:
      back = EachProduct<true, true>(m, count).shares;
      break;
    case kJointPcr5Plus:
      back = EachProduct<false, false>(m, count).shares;
      break;
    case kJointPcr6Plus:
      back = EachProduct<true, false>(m, count).shares;
      break;
  }
  return {q.e + back.e, q.o + back.o, q.t + back.u, q.k};
}

}  // namespace

void joint_double(JointRule rule, const JointSource* sources, int count, const JointResult& out, std::size_t begin,
                  std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    Masses m[kMostJointSources];
    for (int s = 0; s < count; ++s) {
      const JointSource& from = sources[s];
      m[s] = {from.e[i], from.o[i], from.u[i], from.c != nullptr ? from.c[i] : 0};
    }
    const DsmhCell r = joint_cell(rule, m, count);
    const double w = 1 / ((r.e + r.o) + r.t);
    out.e[i] = r.e * w;
    out.o[i] = r.o * w;
    out.u[i] = r.t * w;
    if (out.k != nullptr) out.k[i] = r.k;
  }
}

}  // namespace evigrid::kernels
