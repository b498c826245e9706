// SPDX-License-Identifier: Apache-2.0
// Moving objects against the same shapes standing in the world: cones and rays, occlusion both ways, many threads with
// placements of their own.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstring>
#include <span>
#include <stdexcept>
#include <thread>

#include "both_indices.hpp"
#include "evigrid/raycast/reference.hpp"
#include "evigrid/raycast/scene.hpp"
#include "placed_world.hpp"

namespace evigrid::raycast {
namespace {

using namespace testing;

const Material kShiny{10 * kDegree};
const ConeQuery kAhead{0, 0, 0, 15 * kDegree, 0.1, 5};

TEST(Movers, StandWhereTheirPlacementSays) {
  const std::vector<World> pole{{.circles = {{{1, 0}, 0.1, {}}}}};  // 1 m ahead of its own origin
  const BothIndices scene({.walls = {{{4, -5}, {4, 5}, {}}}}, pole);
  const auto range = [&](Placement p) { return scene.cast_cone(kAhead, {&p, 1}).range_m; };
  EXPECT_NEAR(range({1, 0, 0}), 1.9, 1e-12);
  EXPECT_NEAR(range({2, 1, -90 * kDegree}), 1.9, 1e-12);
  EXPECT_NEAR(range({2, 1, 90 * kDegree}), 4, 1e-12);
  EXPECT_NEAR(range({5, 0, 180 * kDegree}), 3.9, 1e-12);
  EXPECT_EQ(scene.cast_cone(kAhead).range_m, 4) << "without placements it is not there";
  EXPECT_EQ(scene.surface_count(), 2u);
}

TEST(Movers, SilentMoverHidesAnEchoingWallAndTheOtherWayRound) {
  const World wall{.walls = {{{3, -5}, {3, 5}, {}}}};
  const World plate{.walls = {{{-1, -1}, {1, 1}, kShiny}}};  // 45°
  const Placement at{2, 0, 0}, behind{4, 0, 0}, aside{2, 1.2, 0};
  const BothIndices shiny_moves(wall, {&plate, 1});
  EXPECT_EQ(shiny_moves.cast_cone(kAhead, {&at, 1}).status, EchoStatus::none);
  EXPECT_NEAR(shiny_moves.cast_cone(kAhead, {&behind, 1}).range_m, 3, 1e-9);
  // The plate's lower part hides what lies left of the direction to its end (1, 0.2); the wall begins there.
  EXPECT_NEAR(shiny_moves.cast_cone({0, 0, 10 * kDegree, 15 * kDegree, 0.1, 5}, {&aside, 1}).range_m,
              3 / std::cos(2.5 * kDegree), 1e-9);
  const World fixed_plate{.walls = {{{1, -1}, {3, 1}, kShiny}}}, moving_wall{.walls = {{{0, -5}, {0, 5}, {}}}};
  const BothIndices wall_moves(fixed_plate, {&moving_wall, 1});
  const Placement far{3, 0, 0}, near{0.9, 0, 0}, turned{3, 0, 180 * kDegree};
  EXPECT_EQ(wall_moves.cast_cone(kAhead, {&far, 1}).status, EchoStatus::none);
  EXPECT_EQ(wall_moves.cast_cone(kAhead, {&turned, 1}).status, EchoStatus::none);
  EXPECT_NEAR(wall_moves.cast_cone(kAhead, {&near, 1}).range_m, 0.9, 1e-9);
}

void compare(std::uint64_t seed, Point shift, double tolerance_m, bool absorbing) {
  Random r(seed);
  int nearer = 0, hidden = 0;
  for (int k = 0; k < 20; ++k) {
    World fixed;
    put(fixed, random_room(r), {shift.x_m, shift.y_m, 0});
    std::vector<World> shapes = random_movers(r);
    if (absorbing) make_absorbing(fixed, r);
    for (World& s : shapes)
      if (absorbing) make_absorbing(s, r);
    const BothIndices scene(fixed, shapes);
    for (int turn = 0; turn < 4; ++turn) {
      std::vector<Placement> at;
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        at.push_back(random_placement(r));
        at.back().x_m += shift.x_m;
        at.back().y_m += shift.y_m;
      }
      const World all = with(fixed, shapes, at);
      for (int c = 0; c < 20; ++c) {
        ConeQuery q = random_cone(r);
        q.x_m += shift.x_m;
        q.y_m += shift.y_m;
        const Echo expected = reference_cone(all, q), got = scene.cast_cone(q, at);
        EXPECT_EQ(static_cast<int>(got.status), static_cast<int>(expected.status))
            << k << " " << turn << " " << c << ": " << got.range_m << " instead of " << expected.range_m;
        if (expected.status != EchoStatus::none) {
          EXPECT_NEAR(got.range_m, expected.range_m, tolerance_m) << k << " " << turn << " " << c;
        }
        const double ray = scene.ray_range(q.x_m, q.y_m, q.yaw_rad, q.max_range_m, at);
        const double expected_ray = reference_ray(all, q.x_m, q.y_m, q.yaw_rad, q.max_range_m);
        EXPECT_EQ(std::isinf(ray), std::isinf(expected_ray)) << k << " " << turn << " " << c;
        if (!std::isinf(ray)) {
          EXPECT_NEAR(ray, expected_ray, tolerance_m) << k << " " << turn << " " << c;
        }
        const Echo without = scene.cast_cone(q);
        nearer += got.range_m < without.range_m;  // the mover is what is heard
        hidden += got.range_m > without.range_m;  // the mover hides what was
      }
    }
  }
  EXPECT_GT(nearer, 50);
  EXPECT_GT(hidden, 3);
}

TEST(Movers, EqualReferenceWithTheMoversInTheWorld) { compare(31, {}, 1e-8, false); }
TEST(Movers, EqualReferenceWithAbsorption) { compare(32, {}, 1e-8, true); }
TEST(Movers, EqualReferenceFarFromTheOrigin) { compare(33, {432100.25, 5412345.5}, 1e-5, false); }

TEST(Movers, BadPlacementsAndShapesAreRefusedByName) {
  const std::vector<World> two(2);
  const BothIndices scene({}, two);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::vector<Placement> one(1), bad{{}, {0, std::nan(""), 0}};
  EXPECT_EQ(message([&] { (void)scene.cast_cone(kAhead, one); }), "movers: 1 placements for 2 movers");
  EXPECT_EQ(message([&] { (void)scene.ray_range(0, 0, 0, 1, bad); }), "movers: a placement is not finite");
  EXPECT_EQ(message([&] { (void)scene.cross_talk(kAhead, kAhead, one); }), "movers: 1 placements for 2 movers");
  EXPECT_EQ(message([&] { (void)scene.cast_cone_second_bounce(kAhead, bad); }), "movers: a placement is not finite");
  const std::vector<World> shapes{{}, {.circles = {{{0, 0}, -1, {}}}}};
  EXPECT_EQ(message([&] { BothIndices({}, shapes); }), "mover 1: circle 0: radius_m is negative");
}

TEST(Movers, ThreadsCastWithPlacementsOfTheirOwn) {
  Random r(34);
  const World fixed = random_room(r);
  const std::vector<World> shapes = random_movers(r);
  const BothIndices scene(fixed, shapes);
  std::vector<std::vector<Placement>> moments(8);
  for (auto& at : moments)
    for (std::size_t i = 0; i < shapes.size(); ++i) at.push_back(random_placement(r));
  std::vector<ConeQuery> queries;
  for (int i = 0; i < 300; ++i) queries.push_back(random_cone(r));
  // All that can be cast: a bounce with its cone, cross-talk with the cone before, a fan.
  using Answers = std::array<double, 22>;
  const auto cast = [&](std::size_t i, std::size_t m) {
    const ConeQuery &q = queries[i], &other = queries[i / 2];
    Answers a{scene.cast_cone_second_bounce(q, moments[m]).range_m, scene.cross_talk(other, q, moments[m]).range_m};
    scene.cast_fan({q.x_m, q.y_m, q.yaw_rad, 0, 0.1, 20, 5}, std::span(a).subspan<2>(), moments[m]);
    return a;
  };
  std::vector<std::vector<Answers>> alone(moments.size());
  for (std::size_t m = 0; m < moments.size(); ++m)
    for (std::size_t i = 0; i < queries.size(); ++i) alone[m].push_back(cast(i, m));
  std::atomic<int> different = 0;
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < moments.size(); ++t)
      threads.emplace_back([&, t] {
        for (std::size_t n = 0; n < 3 * queries.size(); ++n) {
          const std::size_t i = n % queries.size(), m = (t + n / queries.size()) % moments.size();
          const Answers got = cast(i, m);
          different += std::memcmp(&got, &alone[m][i], sizeof got) != 0;
        }
      });
  }
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace evigrid::raycast
