// SPDX-License-Identifier: Apache-2.0
// Checks the measures, lays the building out in millimetres and turns it into boxes and circles in metres.
#include "evigrid/scenes/building.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "building/furniture.hpp"

namespace evigrid::scenes {
namespace {

constexpr double kMostRooms = 2e6;
constexpr double kMostFurniture = 100;  // per room
constexpr double kDegree = std::numbers::pi / 180;
// Critical incidences (ours, of the order of the embedded scene's): glass is the smoothest.
constexpr raycast::Material kPlaster{35 * kDegree, 0}, kGlass{20 * kDegree, 0}, kWood{45 * kDegree, 0},
    kCloth{75 * kDegree, 0}, kMetal{90 * kDegree, 0};

[[noreturn]] void refuse(const char* field, const std::string& reason) {
  throw std::invalid_argument(std::string(field) + " " + reason);
}

Mm millimetres(double value_m, const char* field, double least_m, double most_m) {
  if (!(value_m >= least_m && value_m <= most_m))
    refuse(field, "is " + std::to_string(value_m) + ": outside [" + std::to_string(least_m) + ", " +
                      std::to_string(most_m) + "]");
  return static_cast<Mm>(std::llround(value_m * 1000));
}

Measures checked(const BuildingSpec& spec) {
  Measures m{};
  m.wall = millimetres(spec.wall_m, "wall_m", 0.02, 2);
  m.door = millimetres(spec.door_m, "door_m", 0.3, 10);
  m.corridor = millimetres(spec.corridor_m, "corridor_m", 0.3, 50);
  m.room = millimetres(spec.room_m, "room_m", 1, 1000);
  m.width = millimetres(spec.width_m, "width_m", 1, 1e5);
  m.depth = millimetres(spec.depth_m, "depth_m", 1, 1e5);
  const Mm least_room = 22 * (m.door + 2 * m.wall + 100) / 10;  // the narrowest piece of a row still holds a door
  if (m.corridor < m.door) refuse("corridor_m", "is less than door_m");
  if (m.room < least_room)
    refuse("room_m",
           "is too small for door_m and wall_m: at least " + std::to_string(static_cast<double>(least_room) / 1000));
  const Mm least = m.door + 2 * m.wall + 300;
  if (m.width < least) refuse("width_m", "is too small for one room with a door");
  if (m.depth < least) refuse("depth_m", "is too small for one room with a door");
  if (spec.width_m / spec.room_m * (spec.depth_m / spec.room_m) > kMostRooms)
    refuse("room_m", "makes more than " + std::to_string(static_cast<int>(kMostRooms)) + " rooms");
  if (!(spec.furniture_per_room >= 0 && spec.furniture_per_room <= kMostFurniture))
    refuse("furniture_per_room", "is outside [0, 100]");
  return m;
}

raycast::Box box(const Rect& r, int yaw_deg, const raycast::Material& material) {
  // One division per number: correctly rounded, the same everywhere.
  return {{static_cast<double>(r.x0 + r.x1) / 2000, static_cast<double>(r.y0 + r.y1) / 2000},
          static_cast<double>(r.width()) / 1000,
          static_cast<double>(r.height()) / 1000,
          yaw_deg * kDegree,
          material};
}

const raycast::Material& material_of(Stuff stuff) {
  return stuff == Stuff::wood ? kWood : stuff == Stuff::cloth ? kCloth : kMetal;
}

}  // namespace

raycast::World make_building(const BuildingSpec& spec) {
  const Measures m = checked(spec);
  const Layout layout = lay_out(m, spec.seed);
  raycast::World world;
  for (const WallPiece& piece : layout.walls)
    world.boxes.push_back(box(piece.rect, 0, piece.finish == Finish::glass ? kGlass : kPlaster));
  for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
    for (const Piece& piece : furnish(layout.rooms[i], m, spec.furniture_per_room, Draws(spec.seed, 2, i))) {
      if (!piece.round) {
        world.boxes.push_back(box(piece.rect, piece.yaw_deg, material_of(piece.stuff)));
        continue;
      }
      const raycast::Box square = box(piece.rect, 0, {});
      world.circles.push_back({square.centre, square.length_m / 2, material_of(piece.stuff)});
    }
  }
  return world;
}

}  // namespace evigrid::scenes
