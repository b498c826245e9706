// SPDX-License-Identifier: Apache-2.0
// What may be left out before the exact code sees it: by the float kernels of every target, by the quick refusal in
// double, by the horizon. Each must keep all that the exact code, or a dense fan of rays, would find.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "random_world.hpp"
#include "raycast/src/capsules.hpp"
#include "raycast/src/horizon.hpp"
#include "raycast/src/nearest_echo.hpp"
#include "raycast/src/reject.hpp"
#include "raycast/src/surface.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

/// Surfaces of every size and kind around the origin; some end exactly on the edges of the wedge.
std::vector<Surface> surfaces_around(Random& r, const Wedge& w, int count) {
  World world;
  for (int i = 0; i < count; ++i) {
    const auto any = [&](double scale) { return Point{r.uniform(-scale, scale), r.uniform(-scale, scale)}; };
    const Vec2 edge = r.uniform(0.1, 4) * (i % 2 ? w.arc.right : w.arc.left);
    const double scale = i % 3 == 0 ? 0.5 : 6;
    if (i % 4 == 0)
      world.circles.push_back({any(scale), i % 8 ? r.uniform(0, 2) : 0, {}});
    else if (i % 4 == 1)
      world.walls.push_back({{edge.x, edge.y}, any(scale), {}});
    else
      world.walls.push_back({any(scale), any(scale), {}});
  }
  return take_apart(world);
}

Wedge any_wedge(Random& r, int i) {
  return make_wedge(r.uniform(-4, 4), i % 10 == 0 ? 0 : i % 10 == 1 ? 3 : r.uniform(0, 1));
}

TEST(Proposals, EveryKernelProposesWhatIsThere) {
  int tested = 0;
  for (const char* target : {"scalar", "avx2", "avx512"}) {
    const CapsuleKernel* kernel = find_capsule_kernel(target);
    if (kernel == nullptr) continue;  // this processor has none
    EXPECT_EQ(kernel->target, target);
    Random r(51);
    std::size_t there = 0, proposed = 0, asked = 0;
    for (int i = 0; i < 400; ++i) {
      const Wedge w = any_wedge(r, i);
      const std::vector<Surface> all = surfaces_around(r, w, 37);
      Capsules c;
      c.resize(all.size());
      for (std::uint32_t k = 0; k < all.size(); ++k)
        c.set(k, all[k].a, all[k].kind == Surface::Kind::segment ? all[k].b : all[k].a, all[k].radius, 1000 + k);
      const auto f = [](double v) { return static_cast<float>(v); };
      const FloatWedge fw{0, 0, f(w.arc.right.x), f(w.arc.right.y), f(w.arc.left.x), f(w.arc.left.y), 4e-5f};
      const double limit = r.uniform(0, 7);
      const std::uint32_t begin = static_cast<std::uint32_t>(i % 5), end = c.size() - static_cast<std::uint32_t>(i % 3);
      Proposals out;
      out.make_room(all.size());
      const std::size_t count = kernel->capsules(c, begin, end, fw, f(limit), out);
      std::set<std::uint32_t> names;
      for (std::size_t k = 0; k < count; ++k) {
        ASSERT_TRUE(names.insert(out.name[k]).second);
        ASSERT_GE(out.name[k], 1000 + begin);
        ASSERT_LT(out.name[k], 1000 + end);
        if (const auto p = nearest_in_wedge(all[out.name[k] - 1000], w)) {
          ASSERT_LE(out.nearest_m[k], length(*p)) << "not a lower bound";
        }
      }
      for (std::uint32_t k = begin; k < end; ++k) {
        const auto p = nearest_in_wedge(all[k], w);
        if (!p || length(*p) > limit) continue;
        ++there;
        ASSERT_TRUE(names.contains(1000 + k)) << target << " " << i << " " << k;
      }
      proposed += count, asked += end - begin;
    }
    EXPECT_GT(there, 1000u);
    EXPECT_LT(proposed, there + there / 5) << "proposes too much to be of use";
    EXPECT_GT(asked, 2 * proposed);
    ++tested;
  }
  EXPECT_GE(tested, 1);
}

TEST(Proposals, EveryKernelFindsTheSquaresThatAWedgeMeets) {
  for (const char* target : {"scalar", "avx2", "avx512"}) {
    const CapsuleKernel* kernel = find_capsule_kernel(target);
    if (kernel == nullptr) continue;
    Random r(52);
    std::size_t met = 0, proposed = 0;
    for (int i = 0; i < 200; ++i) {
      const Wedge w = any_wedge(r, i);
      Squares s;
      s.half_m = 0.75f;
      for (int k = 0; k < 45; ++k)
        s.x.push_back(static_cast<float>(r.uniform(-6, 6))), s.y.push_back(static_cast<float>(r.uniform(-6, 6)));
      s.x.resize(45 + kSpare), s.y.resize(45 + kSpare);
      const auto f = [](double v) { return static_cast<float>(v); };
      const FloatWedge fw{0, 0, f(w.arc.right.x), f(w.arc.right.y), f(w.arc.left.x), f(w.arc.left.y), 4e-5f};
      const double limit = r.uniform(0, 7);
      Proposals out;
      out.make_room(45);
      const std::size_t count = kernel->squares(s, 2, 43, fw, f(limit), out);
      const std::set<std::uint32_t> names(out.name.begin(), out.name.begin() + static_cast<std::ptrdiff_t>(count));
      ASSERT_EQ(names.size(), count);
      // The square as its four sides and its inside.
      for (std::uint32_t k = 2; k < 43; ++k) {
        const double x = s.x[k], y = s.y[k], h = s.half_m;
        double nearest = std::abs(x) <= h && std::abs(y) <= h ? 0 : INFINITY;
        const Vec2 corner[4] = {{x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}};
        for (int side = 0; side < 4; ++side)
          if (const auto p = nearest_of_segment(corner[side], corner[(side + 1) % 4], w))
            nearest = std::min(nearest, length(*p));
        if (nearest > limit) continue;
        ++met;
        ASSERT_TRUE(names.contains(k)) << target << " " << i << " " << k;
      }
      proposed += count;
    }
    EXPECT_GT(met, 500u);
    EXPECT_LT(proposed, 3 * met);
  }
}

TEST(Proposals, RefusalIsNeverWrongAndOftenGiven) {
  Random r(53);
  int refused = 0, outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Wedge w = any_wedge(r, i);
    for (const Surface& s : surfaces_around(r, w, 16)) {
      const auto p = nearest_in_wedge(s, w);
      // Exactly at the limit, too.
      const double limit = p && i % 2 ? length(*p) : r.uniform(0, 7);
      const bool nothing = !p || length(*p) > limit;
      const bool sure = surely_outside(s, w, limit);
      ASSERT_TRUE(nothing || !sure) << i;
      refused += sure, outside += nothing;
    }
  }
  EXPECT_GT(refused, outside / 2);
}

TEST(Proposals, NothingIsSeenBeyondTheHorizon) {
  Random r(54);
  int bounded = 0, cones = 0;
  for (int k = 0; k < 100; ++k) {
    const std::vector<Surface> room = take_apart(random_room(r));
    for (int c = 0; c < 30; ++c, ++cones) {
      const Vec2 apex{r.uniform(0.1, 7.9), r.uniform(0.1, 5.9)};
      const double yaw = r.uniform(-4, 4), aperture = r.uniform(0.01, 0.8), reach = 9;
      const Wedge w = make_wedge(yaw, aperture);
      std::vector<Surface> seen;
      for (const Surface& s : room) seen.push_back(seen_from(s, apex));
      Horizon horizon;
      horizon.begin(w, reach);
      for (const Surface& s : seen)
        if (const auto p = nearest_in_wedge(s, w); p && length(*p) <= horizon.limit_m()) horizon.add(s);
      if (horizon.limit_m() >= reach) continue;
      ++bounded;
      for (int i = 0; i <= 500; ++i) {
        const double angle = yaw + aperture * (i / 500.0 - 0.5);
        double first = INFINITY;
        for (const Surface& s : seen) first = std::min(first, hit_distance(s, {std::cos(angle), std::sin(angle)}));
        ASSERT_LE(first, horizon.limit_m()) << k << " " << c << " " << i;
      }
    }
  }
  EXPECT_GT(bounded, cones / 2);
}

}  // namespace
}  // namespace evigrid::raycast
