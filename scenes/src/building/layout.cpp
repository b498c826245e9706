// SPDX-License-Identifier: Apache-2.0
// Corridors split the floor: each new one leads off an existing one and halves a block, until a block is one or two
// rooms deep. Then the block is cut into rows of rooms along it; a row that touches no corridor opens into the row
// before it.
#include "building/layout.hpp"

#include "building/block.hpp"

namespace evigrid::scenes {
namespace {

class Splitter {
 public:
  Splitter(const Measures& m, std::uint64_t seed, Layout& out) : m_(m), seed_(seed), out_(&out) {}

  void split(const Block& block) {
    const Mm w = block.rect.width(), h = block.rect.height();
    const bool first = !(block.left || block.right || block.low || block.high);  // no corridor yet
    // A corridor along x ends at the left or right side: one of them must be a corridor (or none exists yet).
    const bool x_leads = block.left || block.right || first, y_leads = block.low || block.high || first;
    const bool x_fits = halves_fit(h) && x_leads, y_fits = halves_fit(w) && y_leads;
    if (is_served(block) || (!x_fits && !y_fits)) {
      build_block(block, m_, seed_, number_++, *out_);
      return;
    }
    Draws draws(seed_, 0, number_++);
    const bool along_x = x_fits && (!y_fits || (first ? w >= h : h >= w));
    const Rect& r = block.rect;
    const Mm side = along_x ? h : w, free = side - m_.corridor;
    const Mm at = draws.between(free * 2 / 5, free * 3 / 5);
    Block before = block, after = block;
    if (along_x) {
      before.rect.y1 = r.y0 + at;
      after.rect.y0 = r.y0 + at + m_.corridor;
      before.high = after.low = true;
    } else {
      before.rect.x1 = r.x0 + at;
      after.rect.x0 = r.x0 + at + m_.corridor;
      before.right = after.left = true;
    }
    split(before);
    split(after);
  }

 private:
  /// The smaller half is at least most of a room.
  [[nodiscard]] bool halves_fit(Mm side) const { return (side - m_.corridor) * 2 / 5 >= m_.room * 7 / 10; }
  /// All its rooms can have a door to a corridor.
  [[nodiscard]] bool is_served(const Block& b) const {
    const auto served = [&](Mm depth, bool one, bool other) {
      return (one && other) ? depth <= m_.room * 3 : (one || other) && depth <= m_.room * 8 / 5;
    };
    return served(b.rect.height(), b.low, b.high) || served(b.rect.width(), b.left, b.right);
  }

  Measures m_;
  std::uint64_t seed_, number_ = 0;
  Layout* out_;
};

}  // namespace

Layout lay_out(const Measures& m, std::uint64_t seed) {
  Layout out;
  out.walls = {{{0, 0, m.width, m.wall}, Finish::plaster},
               {{0, m.depth - m.wall, m.width, m.depth}, Finish::plaster},
               {{0, 0, m.wall, m.depth}, Finish::plaster},
               {{m.width - m.wall, 0, m.width, m.depth}, Finish::plaster}};
  Splitter(m, seed, out).split({{0, 0, m.width, m.depth}, false, false, false, false});
  return out;
}

}  // namespace evigrid::scenes
