// SPDX-License-Identifier: Apache-2.0
// Generated buildings: every room reached through its doors, nothing in front of a door, the same from the same seed.
#include "evigrid/scenes/building.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "evigrid/scenes/truth.hpp"
#include "scenes/src/building/layout.hpp"

namespace evigrid::scenes {
namespace {

using raycast::World;

Measures measures(const BuildingSpec& s) {
  const auto mm = [](double m) { return static_cast<Mm>(std::llround(m * 1000)); };
  return {mm(s.width_m), mm(s.depth_m), mm(s.room_m), mm(s.corridor_m), mm(s.door_m), mm(s.wall_m)};
}

std::uint64_t hash(const World& world) {
  std::uint64_t h = 0xcbf29ce484222325u;  // FNV-1a over the bits of every number
  const auto add = [&](double v) {
    for (int k = 0; k < 8; ++k) h = (h ^ (std::bit_cast<std::uint64_t>(v) >> (8 * k) & 0xff)) * 0x100000001b3u;
  };
  for (const auto& b : world.boxes)
    for (const double v :
         {b.centre.x_m, b.centre.y_m, b.length_m, b.width_m, b.yaw_rad, b.material.critical_incidence_rad})
      add(v);
  for (const auto& c : world.circles)
    for (const double v : {c.centre.x_m, c.centre.y_m, c.radius_m, c.material.critical_incidence_rad}) add(v);
  return h;
}

/// Cells that a disc of half a door's width (less the grid's own error) can reach from the middle of the first door.
class Walk {
 public:
  Walk(const World& world, const Layout& layout, const BuildingSpec& spec)
      : grid_(rasterise(world, kCell_m, metres(layout.rooms.front().doors.front()))), reached_(grid_.cells.size(), 0) {
    const auto r = static_cast<std::int64_t>((spec.door_m / 2 - 1.5 * kCell_m) / kCell_m);
    std::vector<std::uint8_t> near(grid_.cells.size(), 0);
    for (std::int64_t i = 0; i < std::ssize(grid_.cells); ++i) {
      if (grid_.cells[static_cast<std::size_t>(i)] != TruthCell::surface) continue;
      for (std::int64_t y = -r; y <= r; ++y)
        for (std::int64_t x = -r; x <= r; ++x) {
          const std::int64_t cx = i % grid_.width + x, cy = i / grid_.width + y;
          if (x * x + y * y <= r * r && cx >= 0 && cy >= 0 && cx < grid_.width && cy < grid_.height)
            near[static_cast<std::size_t>(cy * grid_.width + cx)] = 1;
        }
    }
    std::vector<std::int64_t> open{cell(layout.rooms.front().doors.front())};
    while (!open.empty()) {
      const std::int64_t i = open.back();
      open.pop_back();
      if (i < 0 || i >= std::ssize(near) || near[static_cast<std::size_t>(i)] || reached_[static_cast<std::size_t>(i)])
        continue;
      reached_[static_cast<std::size_t>(i)] = 1;
      for (const std::int64_t step : {std::int64_t{1}, std::int64_t{-1}, grid_.width, -grid_.width})
        open.push_back(i + step);
    }
  }
  [[nodiscard]] bool reaches(const Rect& r) const { return reached_[static_cast<std::size_t>(cell(r))] != 0; }
  [[nodiscard]] bool reaches_inside(const Rect& r) const {
    std::int64_t count = 0;
    for (std::int64_t i = 0; i < std::ssize(reached_); ++i) {
      const double x = (static_cast<double>(grid_.x + i % grid_.width) + 0.5) * kCell_m * 1000;
      const double y = (static_cast<double>(grid_.y + i / grid_.width) + 0.5) * kCell_m * 1000;
      count += reached_[static_cast<std::size_t>(i)] && x > static_cast<double>(r.x0) &&
               x < static_cast<double>(r.x1) && y > static_cast<double>(r.y0) && y < static_cast<double>(r.y1);
    }
    return count > 0;
  }

 private:
  static constexpr double kCell_m = 0.05;
  static raycast::Point metres(const Rect& r) {
    return {static_cast<double>(r.x0 + r.x1) / 2000, static_cast<double>(r.y0 + r.y1) / 2000};
  }
  [[nodiscard]] std::int64_t cell(const Rect& r) const {
    const raycast::Point p = metres(r);
    return (static_cast<std::int64_t>(std::floor(p.y_m / kCell_m)) - grid_.y) * grid_.width +
           static_cast<std::int64_t>(std::floor(p.x_m / kCell_m)) - grid_.x;
  }
  TruthGrid grid_;
  std::vector<std::uint8_t> reached_;
};

TEST(Building, EveryRoomIsReachedThroughItsDoors) {
  int rooms = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    BuildingSpec spec;
    spec.seed = seed;
    spec.width_m = 6 + static_cast<double>(seed * 7 % 41);
    spec.depth_m = 6 + static_cast<double>(seed * 13 % 37);
    spec.furniture_per_room = static_cast<double>(seed % 9);
    spec.room_m = 4 + static_cast<double>(seed % 3);
    spec.door_m = seed % 4 == 0 ? 0.85 : 1.1;
    const Layout layout = lay_out(measures(spec), seed);
    ASSERT_FALSE(layout.rooms.empty());
    if (layout.rooms.size() == 1) continue;  // a single room has no door
    const Walk walk(make_building(spec), layout, spec);
    for (const Room& room : layout.rooms) {
      ASSERT_FALSE(room.doors.empty()) << "seed " << seed;
      for (const Rect& door : room.doors) {
        EXPECT_EQ(std::max(door.width(), door.height()) >= measures(spec).door, true);
        EXPECT_TRUE(walk.reaches(door)) << "seed " << seed << " door at " << door.x0 << ", " << door.y0;
      }
      EXPECT_TRUE(walk.reaches_inside(room.inside)) << "seed " << seed;
      ++rooms;
    }
  }
  EXPECT_GT(rooms, 500);
}

TEST(Building, FurnitureStandsInItsRoomAndNotInDoors) {
  BuildingSpec spec;
  spec.furniture_per_room = 8;
  const Layout layout = lay_out(measures(spec), spec.seed);
  const World world = make_building(spec);
  ASSERT_GT(world.boxes.size(), layout.walls.size());
  std::vector<Rect> pieces;  // bounding boxes, mm
  for (std::size_t i = layout.walls.size(); i < world.boxes.size(); ++i) {
    World one;
    one.boxes.push_back(world.boxes[i]);
    const Extent e = extent(one);
    pieces.push_back({static_cast<Mm>(std::floor(e.low.x_m * 1000)), static_cast<Mm>(std::floor(e.low.y_m * 1000)),
                      static_cast<Mm>(std::ceil(e.high.x_m * 1000)), static_cast<Mm>(std::ceil(e.high.y_m * 1000))});
  }
  for (const auto& c : world.circles) {
    const auto mm = [](double v) { return static_cast<Mm>(std::llround(v * 1000)); };
    const Mm x = mm(c.centre.x_m), y = mm(c.centre.y_m), r = mm(c.radius_m);
    pieces.push_back({x - r, y - r, x + r, y + r});
  }
  EXPECT_GT(pieces.size(), 100u);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Rect& p = pieces[i];
    int holds = 0;
    for (const Room& room : layout.rooms) {
      const Rect& in = room.inside;
      holds += p.x0 >= in.x0 - 1 && p.y0 >= in.y0 - 1 && p.x1 <= in.x1 + 1 && p.y1 <= in.y1 + 1;
      for (const Rect& d : room.doors) {
        // Half a metre in front of the opening on both sides.
        const bool lies_along_x = d.width() == 1000;
        const Rect step =
            lies_along_x ? Rect{d.x0, d.y0 - 500, d.x1, d.y1 + 500} : Rect{d.x0 - 500, d.y0, d.x1 + 500, d.y1};
        EXPECT_FALSE(overlap(p, step));
      }
    }
    EXPECT_EQ(holds, 1);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(p, pieces[j]));
  }
}

TEST(Building, RoomsDoNotOverlapAndLieInside) {
  BuildingSpec spec;
  spec.width_m = 90;
  spec.depth_m = 55;
  const Layout layout = lay_out(measures(spec), 5);
  ASSERT_GT(layout.rooms.size(), 60u);
  for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
    const Rect& a = layout.rooms[i].inside;
    EXPECT_GE(std::min(a.width(), a.height()), 1000);
    EXPECT_GE(std::min(a.x0, a.y0), 150);
    EXPECT_LE(a.x1, 90000 - 150);
    EXPECT_LE(a.y1, 55000 - 150);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(a, layout.rooms[j].inside));
    for (const WallPiece& wall : layout.walls) EXPECT_FALSE(overlap(a, wall.rect));
  }
}

TEST(Building, HasItsSizeAndIsTheSameEverywhere) {
  BuildingSpec spec;
  const World world = make_building(spec);
  const Extent e = extent(world);
  EXPECT_EQ(e.low.x_m, 0);
  EXPECT_EQ(e.low.y_m, 0);
  EXPECT_EQ(e.high.x_m, 40);
  EXPECT_EQ(e.high.y_m, 25);
  EXPECT_EQ(hash(world), hash(make_building(spec)));
  EXPECT_EQ(hash(world), 16822111190968842200u) << "the generated building has changed: so do all maps of it";
  spec.seed = 2;
  EXPECT_NE(hash(world), hash(make_building(spec)));
}

TEST(Building, TakesAnySize) {
  for (const auto& [w, d] : {std::pair{6.0, 6.0}, {6.0, 300.0}, {300.0, 6.0}, {9.5, 9.5}, {500.0, 500.0}}) {
    BuildingSpec spec;
    spec.width_m = w;
    spec.depth_m = d;
    const World world = make_building(spec);
    EXPECT_EQ(extent(world).high.x_m, w);
    EXPECT_EQ(extent(world).high.y_m, d);
    const double rooms = w * d / 25;
    EXPECT_LT(static_cast<double>(world.boxes.size() + world.circles.size()), 4 + 12 * rooms) << w << " x " << d;
  }
}

std::string refusal(const BuildingSpec& spec) {
  try {
    (void)make_building(spec);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

TEST(Building, RefusesBySpecifiedField) {
  const auto changed = [](auto change) {
    BuildingSpec spec;
    change(spec);
    return refusal(spec);
  };
  EXPECT_TRUE(changed([](auto& s) { s.width_m = 0.5; }).starts_with("width_m"));
  EXPECT_TRUE(changed([](auto& s) { s.depth_m = NAN; }).starts_with("depth_m"));
  EXPECT_TRUE(changed([](auto& s) { s.depth_m = 1.2; }).starts_with("depth_m"));
  EXPECT_TRUE(changed([](auto& s) { s.room_m = 2; }).starts_with("room_m"));
  EXPECT_TRUE(changed([](auto& s) { s.width_m = s.depth_m = 9e4; }).starts_with("room_m"));
  EXPECT_TRUE(changed([](auto& s) { s.corridor_m = 0.9; }).starts_with("corridor_m"));
  EXPECT_TRUE(changed([](auto& s) { s.door_m = 0; }).starts_with("door_m"));
  EXPECT_TRUE(changed([](auto& s) { s.wall_m = -1; }).starts_with("wall_m"));
  EXPECT_TRUE(changed([](auto& s) { s.furniture_per_room = -1; }).starts_with("furniture_per_room"));
}

}  // namespace
}  // namespace evigrid::scenes
