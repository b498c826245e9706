// SPDX-License-Identifier: Apache-2.0
// The text of one target's kernel (Highway). Included by exactly one file per target after HWY_TARGET is set, and last:
// what it includes itself was included before for the baseline, so that nothing else is compiled for the target.
//
// A wedge is two half-planes. The ends of a capsule lie on one side or the other of each; where they differ, the edge
// cuts the axis at t = f0 / (f0 − f1). All is widened by radius + margin, so that what rounding moves stays inside:
// with coordinates up to X the products err by a few 1e-7 X, the margin is 4e-6 X.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace evigrid::raycast::EVIGRID_TARGET_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;

/// Appends the lanes where `inside`; answers how many. AVX2 has no instruction for it, and Highway's text for it copies
/// a table of a kilobyte to the stack at every call: few lanes are left mostly, so one by one.
HWY_INLINE std::size_t append(const hn::Mask<Floats>& inside, const hn::Vec<Floats>& nearest_m,
                              const hn::Vec<Words>& name, float* to_nearest_m, std::uint32_t* to_name) {
#if HWY_TARGET == HWY_AVX2
  alignas(32) float all_m[HWY_LANES(float)];
  alignas(32) std::uint32_t all_names[HWY_LANES(float)];
  hn::Store(nearest_m, Floats(), all_m);
  hn::Store(name, Words(), all_names);
  std::uint8_t mask[8] = {};
  hn::StoreMaskBits(Floats(), inside, mask);
  std::size_t n = 0;
  for (unsigned left = mask[0]; left != 0; left &= left - 1, ++n) {
    const int lane = __builtin_ctz(left);
    to_nearest_m[n] = all_m[lane];
    to_name[n] = all_names[lane];
  }
  return n;
#else
  hn::CompressStore(nearest_m, inside, Floats(), to_nearest_m);
  return hn::CompressStore(name, hn::RebindMask(Words(), inside), Words(), to_name);
#endif
}

HWY_ATTR std::size_t capsules(const Capsules& c, std::uint32_t begin, std::uint32_t end, const FloatWedge& w,
                              float limit_m, Proposals& out) {
  const Floats d;
  const auto px = hn::Set(d, w.x), py = hn::Set(d, w.y);
  const auto rx = hn::Set(d, w.right_x), ry = hn::Set(d, w.right_y), lx = hn::Set(d, w.left_x),
             ly = hn::Set(d, w.left_y);
  const auto margin = hn::Set(d, w.margin_m), limit = hn::Set(d, limit_m);
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  std::size_t at = 0;
  for (std::size_t k = begin; k < end; k += hn::Lanes(d)) {
    const auto ax = hn::Sub(hn::LoadU(d, &c.x0[k]), px), ay = hn::Sub(hn::LoadU(d, &c.y0[k]), py);
    const auto bx = hn::Sub(hn::LoadU(d, &c.x1[k]), px), by = hn::Sub(hn::LoadU(d, &c.y1[k]), py);
    const auto wide = hn::Add(hn::LoadU(d, &c.radius[k]), margin);
    const auto right_a = hn::Add(hn::MulSub(rx, ay, hn::Mul(ry, ax)), wide);
    const auto right_b = hn::Add(hn::MulSub(rx, by, hn::Mul(ry, bx)), wide);
    const auto left_a = hn::Add(hn::MulSub(ly, ax, hn::Mul(lx, ay)), wide);
    const auto left_b = hn::Add(hn::MulSub(ly, bx, hn::Mul(lx, by)), wide);
    auto inside = hn::Ge(hn::Min(hn::Max(right_a, right_b), hn::Max(left_a, left_b)), zero);
    if (end - k < hn::Lanes(d)) inside = hn::And(inside, hn::FirstN(d, end - k));
    if (hn::AllFalse(d, inside)) continue;
    const auto cut_right = hn::Div(right_a, hn::Sub(right_a, right_b));
    const auto cut_left = hn::Div(left_a, hn::Sub(left_a, left_b));
    const auto low = hn::Max(hn::IfThenElseZero(hn::Lt(right_a, zero), cut_right),
                             hn::IfThenElseZero(hn::Lt(left_a, zero), cut_left));
    const auto high = hn::Min(hn::IfThenElse(hn::Lt(right_b, zero), cut_right, one),
                              hn::IfThenElse(hn::Lt(left_b, zero), cut_left, one));
    inside = hn::And(inside, hn::Le(low, hn::Add(high, hn::Set(d, 1e-6f))));
    const auto ex = hn::Sub(bx, ax), ey = hn::Sub(by, ay);
    const auto square = hn::Max(hn::MulAdd(ex, ex, hn::Mul(ey, ey)), hn::Set(d, 1e-30f));
    const auto foot = hn::Neg(hn::Div(hn::MulAdd(ax, ex, hn::Mul(ay, ey)), square));
    const auto u = hn::Min(hn::Max(foot, low), high);
    const auto x = hn::MulAdd(u, ex, ax), y = hn::MulAdd(u, ey, ay);
    const auto nearest = hn::Sub(hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y))), wide);
    inside = hn::And(inside, hn::Le(nearest, limit));
    if (hn::AllFalse(d, inside)) continue;
    at += append(inside, nearest, hn::LoadU(Words(), &c.name[k]), &out.nearest_m[at], &out.name[at]);
  }
  return at;
}

HWY_ATTR std::size_t squares(const Squares& s, std::uint32_t begin, std::uint32_t end, const FloatWedge& w,
                             float limit_m, Proposals& out) {
  const Floats d;
  const auto px = hn::Set(d, w.x), py = hn::Set(d, w.y);
  const auto rx = hn::Set(d, w.right_x), ry = hn::Set(d, w.right_y), lx = hn::Set(d, w.left_x),
             ly = hn::Set(d, w.left_y);
  const auto half = hn::Set(d, s.half_m), margin = hn::Set(d, w.margin_m), limit = hn::Set(d, limit_m);
  const auto zero = hn::Zero(d);
  // How far a square reaches beyond its centre, across each edge.
  const auto right_reach = hn::MulAdd(hn::Add(hn::Abs(rx), hn::Abs(ry)), half, margin);
  const auto left_reach = hn::MulAdd(hn::Add(hn::Abs(lx), hn::Abs(ly)), half, margin);
  std::size_t at = 0;
  for (std::size_t k = begin; k < end; k += hn::Lanes(d)) {
    const auto x = hn::Sub(hn::LoadU(d, &s.x[k]), px), y = hn::Sub(hn::LoadU(d, &s.y[k]), py);
    const auto right = hn::Add(hn::MulSub(rx, y, hn::Mul(ry, x)), right_reach);
    const auto left = hn::Add(hn::MulSub(ly, x, hn::Mul(lx, y)), left_reach);
    auto inside = hn::Ge(hn::Min(right, left), zero);
    if (end - k < hn::Lanes(d)) inside = hn::And(inside, hn::FirstN(d, end - k));
    const auto beside = hn::Max(hn::Sub(hn::Abs(x), half), zero), above = hn::Max(hn::Sub(hn::Abs(y), half), zero);
    const auto nearest = hn::Sub(hn::Sqrt(hn::MulAdd(beside, beside, hn::Mul(above, above))), margin);
    inside = hn::And(inside, hn::Le(nearest, limit));
    if (hn::AllFalse(d, inside)) continue;
    const auto number = hn::Add(hn::Iota(Words(), 0), hn::Set(Words(), static_cast<std::uint32_t>(k)));
    at += append(inside, nearest, number, &out.nearest_m[at], &out.name[at]);
  }
  return at;
}

}  // namespace
}  // namespace evigrid::raycast::EVIGRID_TARGET_NAMESPACE
HWY_AFTER_NAMESPACE();
