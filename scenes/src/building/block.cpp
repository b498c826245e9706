// SPDX-License-Identifier: Apache-2.0
// Everything is laid out along x with the rows stacked upwards; a block whose corridors lie left and right is built
// with x and y exchanged. All walls of a block lie within its rectangle.
#include "building/block.hpp"

#include <algorithm>
#include <utility>

namespace evigrid::scenes {
namespace {

Rect exchanged(const Rect& r) { return {r.y0, r.x0, r.y1, r.x1}; }

Mm rounded_count(Mm length, Mm unit) { return std::max<Mm>(1, (length + unit / 2) / unit); }

class Builder {
 public:
  Builder(const Block& block, const Measures& m, std::uint64_t seed, std::uint64_t number, Layout& out)
      : block_(block), m_(m), draws_(seed, 1, number), out_(&out) {
    // Rows go along the corridors that leave the least depth to each.
    const auto worse = [](Mm depth, bool one, bool other) { return one && other ? depth : depth * 2; };
    const Mm w = block.rect.width(), h = block.rect.height();
    const bool across = block.low || block.high, along = block.left || block.right;
    exchange_ = across != along ? along : worse(w, block.left, block.right) < worse(h, block.low, block.high);
    if (exchange_) {
      block_.rect = exchanged(block.rect);
      std::swap(block_.left, block_.low);
      std::swap(block_.right, block_.high);
    }
  }

  void build() {
    const Rect& r = block_.rect;
    const Mm count = rounded_count(r.height(), m_.room * 6 / 5);
    // Rows below the middle are entered from the low corridor, the others from the high one, where there is one.
    const Mm from_low = !block_.high ? count : !block_.low ? 0 : (count + 1) / 2;
    std::vector<Mm> y = cuts(r.y0, r.y1, count);
    side_walls();
    std::vector<Mm> x;
    std::vector<std::size_t> before;  // rooms of the row that this one opens into
    for (Mm row = 0; row < from_low; ++row) {
      const bool corridor = row == 0 && block_.low;
      if (row == 0) x = columns();
      before = build_row(x, y[index(row)], y[index(row + 1)], corridor, row == 0 && !block_.low, true, before);
    }
    before.clear();
    for (Mm row = count; row-- > from_low;) {
      if (row + 1 == count) x = columns();
      before = build_row(x, y[index(row)], y[index(row + 1)], row + 1 == count, false, false, before);
    }
    // The wall between the last row from below and the last from above has no doors.
    if (from_low > 0 && from_low < count) {
      const Mm middle = y[index(from_low)];
      wall({r.x0, middle - m_.wall / 2, r.x1, middle - m_.wall / 2 + m_.wall}, Finish::plaster);
    }
    // A single row between two corridors is entered from the low one.
    if (block_.high && from_low == count) wall({r.x0, r.y1 - m_.wall, r.x1, r.y1}, Finish::plaster);
  }

 private:
  static std::size_t index(Mm i) { return static_cast<std::size_t>(i); }

  /// Ends of `count` about equal pieces, moved by up to a seventh of a piece.
  std::vector<Mm> cuts(Mm from, Mm to, Mm count) {
    std::vector<Mm> at{from};
    const Mm piece = (to - from) / count;
    for (Mm i = 1; i < count; ++i) at.push_back(from + (to - from) * i / count + draws_.between(-piece / 7, piece / 7));
    at.push_back(to);
    return at;
  }
  std::vector<Mm> columns() {
    const Rect& r = block_.rect;
    return cuts(r.x0, r.x1, rounded_count(r.width(), m_.room * draws_.between(85, 125) / 100));
  }

  void wall(const Rect& r, Finish finish) {
    if (r.width() > 0 && r.height() > 0) out_->walls.push_back({exchange_ ? exchanged(r) : r, finish});
  }
  void side_walls() {
    const Rect& r = block_.rect;
    if (block_.left) wall({r.x0, r.y0, r.x0 + m_.wall, r.y1}, Finish::plaster);
    if (block_.right) wall({r.x1 - m_.wall, r.y0, r.x1, r.y1}, Finish::plaster);
  }
  /// A wall from x0 to x1 with one door somewhere between door_x0 and door_x1.
  Rect wall_with_door(Rect r, Mm door_x0, Mm door_x1, Finish finish) {
    const Mm at = draws_.between(door_x0, door_x1 - m_.door);
    wall({r.x0, r.y0, at, r.y1}, finish);
    wall({at + m_.door, r.y0, r.x1, r.y1}, finish);
    return {at, r.y0, at + m_.door, r.y1};
  }
  void add_door(std::size_t room, const Rect& door) {
    out_->rooms[room].doors.push_back(exchange_ ? exchanged(door) : door);
  }

  /// One row of rooms between y0 and y1, entered from below (`upwards`) or from above: from the corridor or from the
  /// rooms `before`. `chained`: the rooms are joined to one another, since no corridor exists.
  std::vector<std::size_t> build_row(const std::vector<Mm>& x, Mm y0, Mm y1, bool corridor, bool chained, bool upwards,
                                     const std::vector<std::size_t>& before) {
    const Rect& r = block_.rect;
    const Mm half = m_.wall / 2, rest = m_.wall - half;
    const Mm low = y0 == r.y0 ? y0 + m_.wall : y0 + rest, high = y1 == r.y1 ? y1 - m_.wall : y1 - half;
    // The wall through which the row is entered.
    const Mm e0 = upwards ? (y0 == r.y0 ? y0 : y0 - half) : (y1 == r.y1 ? y1 - m_.wall : y1 - half), e1 = e0 + m_.wall;
    std::vector<std::size_t> rooms;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const Mm left = i == 0 ? x[i] + m_.wall : x[i] + rest,
               right = i + 2 == x.size() ? x[i + 1] - m_.wall : x[i + 1] - half;
      const Rect inside{left, low, right, high};
      rooms.push_back(out_->rooms.size());
      out_->rooms.push_back({exchange_ ? exchanged(inside) : inside, {}});
      const Mm jamb = std::min<Mm>(100, (right - left - m_.door) / 2);
      if (corridor || !before.empty()) {
        const Finish finish = corridor && draws_.chance(15) ? Finish::glass : Finish::plaster;
        const Rect door = wall_with_door({x[i], e0, x[i + 1], e1}, left + jamb, right - jamb, finish);
        add_door(rooms.back(), door);
        if (!before.empty()) add_door(before[i], door);
      }
      if (i == 0) continue;
      const Rect between{x[i] - half, y0, x[i] - half + m_.wall, y1};
      if (!chained) {
        wall(between, Finish::plaster);
        continue;
      }
      const Mm y_jamb = std::min<Mm>(100, (high - low - m_.door) / 2);
      const Mm at = draws_.between(low + y_jamb, high - y_jamb - m_.door);
      wall({between.x0, y0, between.x1, at}, Finish::plaster);
      wall({between.x0, at + m_.door, between.x1, y1}, Finish::plaster);
      for (const std::size_t room : {rooms[i - 1], rooms[i]})
        add_door(room, {between.x0, at, between.x1, at + m_.door});
    }
    return rooms;
  }

  Block block_;
  Measures m_;
  Draws draws_;
  Layout* out_;
  bool exchange_ = false;
};

}  // namespace

void build_block(const Block& block, const Measures& measures, std::uint64_t seed, std::uint64_t number, Layout& out) {
  Builder(block, measures, seed, number, out).build();
}

}  // namespace evigrid::scenes
