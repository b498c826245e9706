// SPDX-License-Identifier: Apache-2.0
// [[mover]]: a person, another robot. Its shape in a frame of its own whose x axis points where it walks, and its way.
#include "read.hpp"

namespace evigrid::scenes {
namespace {

constexpr std::size_t kMostMovers = 1000;

}  // namespace

std::vector<MoverSpec> read_movers(Table& root, const Materials& materials) {
  std::vector<MoverSpec> movers;
  for (Table& t : root.tables("mover", kMostMovers)) {
    MoverSpec mover;
    mover.name = t.text_or("name", "mover");
    read_route(t, mover.trajectory);
    mover.loop = t.boolean_or("loop", mover.loop);
    mover.shape = read_shapes(t, materials);
    t.refuse_unknown_keys();
    const raycast::World& s = mover.shape;
    if (s.walls.empty() && s.boxes.empty() && s.circles.empty() && s.polygons.empty())
      t.fail("", "has no shape: neither walls nor boxes, circles or polygons");
    movers.push_back(std::move(mover));
  }
  return movers;
}

}  // namespace evigrid::scenes
