// SPDX-License-Identifier: Apache-2.0
#include "building/furniture.hpp"

#include <algorithm>
#include <utility>

namespace evigrid::scenes {
namespace {

constexpr Mm kDoorstep = 1200;  // kept free in front of a door, mm
constexpr Mm kApart = 50;       // between two pieces
constexpr int kTries = 8;
constexpr int kMostYaw_deg = 10;  // sin < 1/4: what a turned box needs beyond its rectangle is bounded by a quarter

Rect grown(const Rect& r, Mm by) { return {r.x0 - by, r.y0 - by, r.x1 + by, r.y1 + by}; }

bool within(const Rect& r, const Rect& outer) {
  return r.x0 >= outer.x0 && r.y0 >= outer.y0 && r.x1 <= outer.x1 && r.y1 <= outer.y1;
}

/// Floor that must stay free for this door.
void keep_free(const Room& room, const Rect& door, const Measures& m, std::vector<Rect>& taken) {
  const Rect& in = room.inside;
  const bool in_x_wall = door.y1 <= in.y0 || door.y0 >= in.y1;  // the door's wall runs along x
  taken.push_back(in_x_wall ? Rect{door.x0 - 100, door.y0 - kDoorstep, door.x1 + 100, door.y1 + kDoorstep}
                            : Rect{door.x0 - kDoorstep, door.y0 - 100, door.x1 + kDoorstep, door.y1 + 100});
  if (room.doors.size() < 2) return;
  const Mm x = (in.x0 + in.x1) / 2, y = (in.y0 + in.y1) / 2, half = m.door / 2;
  const Rect middle{x - half, y - half, x + half, y + half};
  const auto joined = [](const Rect& a, const Rect& b) {
    return Rect{std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
  };
  const Rect corner =
      in_x_wall ? Rect{door.x0, middle.y0, door.x1, middle.y1} : Rect{middle.x0, door.y0, middle.x1, door.y1};
  taken.push_back(joined(door, corner));
  taken.push_back(joined(corner, middle));
}

class Furnisher {
 public:
  Furnisher(const Room& room, const Measures& m, Draws draws) : in_(room.inside), draws_(draws) {
    for (const Rect& door : room.doors) keep_free(room, door, m, taken_);
  }

  void add_one() {
    const Mm kind = draws_.between(0, 99);
    if (kind < 30) {
      desk();
    } else if (kind < 55) {  // cabinet or shelf
      against_wall(draws_.between(800, 2000), draws_.between(350, 450), draws_.chance(30) ? Stuff::metal : Stuff::wood);
    } else if (kind < 67) {
      against_wall(draws_.between(1500, 2100), draws_.between(800, 900), Stuff::cloth);  // sofa
    } else if (kind < 82) {
      round_table();
    } else {
      round_piece(draws_.between(150, 250), Stuff::metal);  // pot, bin
    }
  }

  std::vector<Piece> pieces;

 private:
  bool free(const Rect& r) const {
    if (!within(r, in_)) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const Rect& t) { return overlap(r, t); });
  }
  void put(const Piece& piece, const Rect& needs) {
    pieces.push_back(piece);
    taken_.push_back(grown(needs, kApart));
  }
  Rect anywhere(Mm length, Mm width) {
    const Mm x = draws_.between(in_.x0, in_.x1 - length), y = draws_.between(in_.y0, in_.y1 - width);
    return {x, y, x + length, y + width};
  }

  void against_wall(Mm length, Mm depth, Stuff stuff) {
    for (int i = 0; i < kTries; ++i) {
      const Mm wall = draws_.between(0, 3), gap = draws_.between(10, 40);
      Rect r = wall < 2 ? anywhere(length, depth) : anywhere(depth, length);
      if (wall == 0) r.y0 = in_.y0 + gap, r.y1 = r.y0 + depth;
      if (wall == 1) r.y1 = in_.y1 - gap, r.y0 = r.y1 - depth;
      if (wall == 2) r.x0 = in_.x0 + gap, r.x1 = r.x0 + depth;
      if (wall == 3) r.x1 = in_.x1 - gap, r.x0 = r.x1 - depth;
      if (free(r)) return put({r, false, 0, stuff}, r);
    }
  }

  /// A desk, mostly square to the room, with a chair on one long side.
  void desk() {
    for (int i = 0; i < kTries; ++i) {
      const bool upright = draws_.chance(50);
      const Mm length = draws_.between(1200, 1800), width = 800, chair = 220;
      const Rect r = upright ? anywhere(width, length) : anywhere(length, width);
      const int yaw = draws_.chance(25) ? static_cast<int>(draws_.between(-kMostYaw_deg, kMostYaw_deg)) : 0;
      const Mm spare_x = yaw == 0 ? 0 : r.height() / 8, spare_y = yaw == 0 ? 0 : r.width() / 8;
      const Rect needs{r.x0 - spare_x, r.y0 - spare_y, r.x1 + spare_x, r.y1 + spare_y};
      if (!free(needs)) continue;
      put({r, false, yaw, Stuff::wood}, needs);
      const bool beyond = draws_.chance(50);
      const Mm x = upright ? (beyond ? needs.x1 + chair + 60 : needs.x0 - chair - 60) : (r.x0 + r.x1) / 2;
      const Mm y = upright ? (r.y0 + r.y1) / 2 : (beyond ? needs.y1 + chair + 60 : needs.y0 - chair - 60);
      round_at(x, y, chair, Stuff::cloth);
      return;
    }
  }

  bool round_at(Mm x, Mm y, Mm radius, Stuff stuff) {
    const Rect r{x - radius, y - radius, x + radius, y + radius};
    if (!free(r)) return false;
    put({r, true, 0, stuff}, r);
    return true;
  }
  bool round_piece(Mm radius, Stuff stuff) {
    for (int i = 0; i < kTries; ++i) {
      const Mm x = draws_.between(in_.x0 + radius + 50, in_.x1 - radius - 50);
      const Mm y = draws_.between(in_.y0 + radius + 50, in_.y1 - radius - 50);
      if (round_at(x, y, radius, stuff)) return true;
    }
    return false;
  }
  void round_table() {
    const Mm radius = draws_.between(400, 600), chair = 220;
    if (!round_piece(radius, Stuff::wood)) return;
    const Rect table = pieces.back().rect;
    const Mm x = (table.x0 + table.x1) / 2, y = (table.y0 + table.y1) / 2, off = radius + chair + 60;
    if (draws_.chance(70)) round_at(x - off, y, chair, Stuff::cloth);
    if (draws_.chance(70)) round_at(x + off, y, chair, Stuff::cloth);
    if (draws_.chance(70)) round_at(x, y - off, chair, Stuff::cloth);
    if (draws_.chance(70)) round_at(x, y + off, chair, Stuff::cloth);
  }

  Rect in_;
  Draws draws_;
  std::vector<Rect> taken_;
};

}  // namespace

std::vector<Piece> furnish(const Room& room, const Measures& measures, double mean_count, Draws draws) {
  const auto count = static_cast<int>(2 * mean_count * draws.unit() + draws.unit());  // its mean is mean_count
  Furnisher furnisher(room, measures, draws);
  for (int i = 0; i < count; ++i) furnisher.add_one();
  return std::move(furnisher.pieces);
}

}  // namespace evigrid::scenes
