// SPDX-License-Identifier: Apache-2.0
#include "paper/delafosse2007/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "evigrid/scenes/truth.hpp"
#include "paper/delafosse2007/plan_loop.hpp"
#include "paper/plan_part.hpp"

namespace evigrid::driver {
namespace {

constexpr const char *kScene = "delafosse2007", *kRobot = "laser360";
constexpr int kMargin = 20;  // cells around the world
/// Wheels: 0.02 % of drift each way, 2 mm of noise over a metre (ours).
constexpr scenes::OdometrySpec kWheels{true, 0.4, -0.0002, 0.0002, 0.002};

scenes::Pose between(const scenes::Pose& a, const scenes::Pose& b) {
  const double c = std::cos(a.yaw_rad), s = std::sin(a.yaw_rad), dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
  return {c * dx + s * dy, -s * dx + c * dy, b.yaw_rad - a.yaw_rad};
}

/// Section 3.5: of the 3 × 3 cells around the platform the one whose primitives are nearest to their beacons.
scenes::Pose corrected(const scenes::Pose& at, double cell_m,
                       const std::vector<std::pair<raycast::Point, raycast::Point>>& pairs) {
  scenes::Pose best = at;
  double least = INFINITY;
  for (const int dy : {0, -1, 1}) {  // of equal ones where it is
    for (const int dx : {0, -1, 1}) {
      double sum = 0;
      for (const auto& [seen, beacon] : pairs)
        sum += std::hypot(seen.x_m + dx * cell_m - beacon.x_m, seen.y_m + dy * cell_m - beacon.y_m);
      if (sum < least) least = sum, best = {at.x_m + dx * cell_m, at.y_m + dy * cell_m, at.yaw_rad};
    }
  }
  return best;
}

}  // namespace

namespace {

LoopWorld paper_hall(const PaperOptions& o) {
  LoopWorld w{PaperWorld(paper_scene({.seed = o.seed}, kScene, kRobot)), {}, {}, {}, {}, {}, {}};
  w.edges = vertical_edges(w.room.scene.world);
  w.radii_m = edge_radii(w.room.scene.world);
  return w;
}

/// A loop and landmarks of the user's building, at the paper's speed and stops.
LoopWorld users_building(const PaperOptions& o) {
  const scenes::TrajectorySpec paper = paper_scene({.seed = o.seed}, kScene, kRobot).trajectory;
  const PaperWorld building(paper_scene(o, kScene, kRobot));
  scenes::Scene scene = building.scene;
  const double reach_m = StereoSpec{}.reach_m;
  const auto& tour = scene.trajectory.waypoints;
  PlanWays ways(scene);
  const std::vector<raycast::Point> loop = closed_loop(
      building, ways, standing_corners(scene.world, ways, tour, reach_m), reach_m, !o.start.empty(), o.world);
  std::vector<raycast::Point> edges = standing_corners(scene.world, ways, loop, reach_m);
  scene.trajectory.waypoints = loop;
  scene.trajectory.speed_m_s = paper.speed_m_s, scene.trajectory.turn_rate_rad_s = paper.turn_rate_rad_s;
  scene.trajectory.period_s = paper.period_s;
  scene.world = part_around(scene.world, loop, reach_m + 1);
  std::vector<double> radii_m(edges.size(), 0);
  for (const raycast::Circle& c : scene.world.circles) edges.push_back(c.centre), radii_m.push_back(c.radius_m);
  return {PaperWorld(std::move(scene)), std::move(edges), std::move(radii_m), {}, {}, {}, o.world};
}

}  // namespace

LoopWorld make_loop_world(const PaperOptions& o) {
  LoopWorld w = o.world.empty() ? paper_hall(o) : users_building(o);
  const scenes::Scene& scene = w.room.scene;
  const double c = scene.map.cell_m;
  const scenes::Extent box = scenes::extent(scene.world);
  w.rect = {std::llround(std::floor(box.low.x_m / c)) - kMargin, std::llround(std::floor(box.low.y_m / c)) - kMargin, 0,
            0};
  w.rect.width = std::llround(std::ceil(box.high.x_m / c)) + kMargin - w.rect.x;
  w.rect.height = std::llround(std::ceil(box.high.y_m / c)) + kMargin - w.rect.y;
  w.truth = scenes::drive(scene.trajectory);
  w.odometry = scenes::dead_reckoning(scene.trajectory, kWheels);
  if (o.quick) w.truth.resize(std::min<std::size_t>(w.truth.size(), 60)), w.odometry.resize(w.truth.size());
  return w;
}

LoopRun map_loop(const LoopWorld& w, Evidence evidence, const LoopVariant& variant) {
  LoopRun out;
  const StereoSpec stereo;
  const double cell_m = w.room.scene.map.cell_m;
  TbmGrid grid(w.rect, cell_m);
  out.in_sight.resize(w.edges.size());
  scenes::Pose at = w.odometry.front();
  for (std::size_t stop = 0; stop < w.truth.size(); ++stop) {
    if (stop > 0) at = compose(at, between(w.odometry[stop - 1], w.odometry[stop]));
    if (variant.true_heading) at.yaw_rad = w.truth[stop].yaw_rad;
    Acquisition seen =
        acquire(stereo, *w.room.caster, w.edges, w.radii_m, w.truth[stop], w.room.scene.trajectory.seed, stop);
    out.blind += seen.edges.empty();
    for (const int edge : seen.edges) out.in_sight[static_cast<std::size_t>(edge)] = true;
    out.parallel += seen.parallel, out.too_wide += seen.too_wide, out.primitives += seen.primitives.size();
    // The strong primitives first.
    std::stable_sort(seen.primitives.begin(), seen.primitives.end(), [](const Primitive& a, const Primitive& b) {
      return a.exists.yes - a.exists.no > b.exists.yes - b.exists.no;
    });
    std::vector<bool> taken(out.beacons.size());
    std::vector<Association> found;
    std::vector<std::pair<raycast::Point, raycast::Point>> pairs;
    for (const Primitive& p : seen.primitives) {
      const Placed here = placed(p, at);
      found.push_back(associate(here, out.beacons, taken, kGate_m));
      if (found.back().beacon < 0) continue;
      const auto b = static_cast<std::size_t>(found.back().beacon);
      taken[b] = true;
      pairs.emplace_back(here.centre(), out.beacons[b].centre);
      ++out.matches;
      out.false_matches += p.landmark < 0;
    }
    if (!pairs.empty()) at = corrected(at, cell_m, pairs);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Placed here = placed(seen.primitives[i], at);
      Existence news = here.exists;
      std::size_t b = out.beacons.size();
      if (found[i].beacon >= 0) {
        b = static_cast<std::size_t>(found[i].beacon);
        news = fused(here.exists, certainty_of_match(found[i].p));
        out.beacons[b].exists = fused(out.beacons[b].exists, news);
        ++out.beacons[b].matched;
      } else {
        out.beacons.push_back({here.centre(), here.exists, 0});
      }
      const Existence& told = evidence == Evidence::accumulated ? out.beacons[b].exists : news;
      grid.fuse_box(here.x, here.y, told);
      grid.fuse_free({at.x_m, at.y_m}, here.x, here.y, told);
      out.beacons[b].centre = grid.gravity(variant.box_centre ? here.centre() : out.beacons[b].centre);
    }
    out.way.push_back({at.x_m, at.y_m, at.yaw_rad});
    const scenes::Pose &is = w.truth[stop], &odo = w.odometry[stop];
    out.error_m.push_back(std::hypot(at.x_m - is.x_m, at.y_m - is.y_m));
    out.odometry_error_m.push_back(std::hypot(odo.x_m - is.x_m, odo.y_m - is.y_m));
  }
  if (out.blind == w.truth.size())
    throw InputError(
        fmt::format("{}: none of the {} stops of the loop has a vertical edge within {:g} m in sight: the "
                    "plan is too open, or nothing in it has corners",
                    w.plan, w.truth.size(), stereo.reach_m));
  out.layers = grid.layers();
  return out;
}

Landmarks judge(const LoopRun& m, const LoopWorld& w) {
  Landmarks out;
  std::vector<bool> hit(w.edges.size());
  for (const Beacon& b : m.beacons) {
    if (b.exists.yes < kSure * (1 - b.exists.empty) || b.matched < kSeen) continue;
    double least = INFINITY;
    std::size_t of = 0;
    for (std::size_t i = 0; i < w.edges.size(); ++i) {
      const double d = std::hypot(w.edges[i].x_m - b.centre.x_m, w.edges[i].y_m - b.centre.y_m);
      if (d < least) least = d, of = i;
    }
    ++out.sure;
    out.within += least <= kLandmark_m;
    hit[of] = hit[of] || least <= kLandmark_m;
    out.mean_m += least;
    out.most_m = std::max(out.most_m, least);
  }
  if (out.sure > 0) out.mean_m /= static_cast<double>(out.sure);
  out.found = static_cast<std::size_t>(std::count(hit.begin(), hit.end(), true));
  return out;
}

}  // namespace evigrid::driver
