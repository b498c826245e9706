// SPDX-License-Identifier: Apache-2.0
#include "paper/delafosse2007/stereo.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "evigrid/raycast/noise.hpp"

namespace evigrid::driver {
namespace {

constexpr double kCovered_m = 0.02;  // an edge is hidden when the first surface is nearer than it by more than this
constexpr double kTurning = 0.71;    // figure 7: where the correlation says nothing

double unit(const raycast::NoiseKey& key, std::uint32_t draw) {
  return static_cast<double>(raycast::random_bits(key, draw) >> 11) * 0x1p-53;
}

/// Direction of the edge from a camera, in the map; nullopt when something hides it or it is too far.
std::optional<double> direction(const raycast::Scene& caster, const scenes::Pose& camera, raycast::Point edge,
                                double radius_m, double reach_m) {
  const double dx = edge.x_m - camera.x_m, dy = edge.y_m - camera.y_m, d = std::hypot(dx, dy);
  if (d > reach_m || d < 0.1) return std::nullopt;
  const double towards = std::atan2(dy, dx);
  const double seen = caster.ray_range(camera.x_m, camera.y_m, towards, reach_m + 1);
  if (seen < d - radius_m - kCovered_m) return std::nullopt;
  return towards;
}

}  // namespace

Existence existence_of_match(double r) noexcept {
  return r < kTurning ? Existence{0, 1 - r / kTurning, 0} : Existence{(r - kTurning) / (1 - kTurning), 0, 0};
}

bool triangulate(Interval alpha, Interval beta, double d, Interval& x, Interval& y) {
  const Interval between = sine(beta - alpha);
  if (between.has(0)) return false;
  const Interval base{d, d};
  x = base * sine(beta) * cosine(alpha) / between;
  y = base * sine(alpha) * sine(beta) / between;
  return true;
}

std::vector<raycast::Point> vertical_edges(const raycast::World& world) {
  std::vector<raycast::Point> out;
  for (const raycast::Polygon& p : world.polygons) out.insert(out.end(), p.vertices.begin(), p.vertices.end());
  for (const raycast::Wall& w : world.walls) out.insert(out.end(), {w.from, w.to});
  for (const raycast::Circle& c : world.circles) out.push_back(c.centre);
  return out;
}

std::vector<double> edge_radii(const raycast::World& world) {
  std::vector<double> out(vertical_edges(world).size(), 0);
  for (std::size_t i = 0; i < world.circles.size(); ++i)
    out[out.size() - world.circles.size() + i] = world.circles[i].radius_m;
  return out;
}

Acquisition acquire(const StereoSpec& spec, const raycast::Scene& caster, const std::vector<raycast::Point>& edges,
                    const std::vector<double>& radii_m, const scenes::Pose& platform, std::uint64_t seed,
                    std::uint64_t stop) {
  // Frame of the pair: its x axis from the left camera to the right one, which is the platform's −y.
  const scenes::Pose pair{0, spec.baseline_m / 2, -std::numbers::pi / 2};
  const scenes::Pose left = compose(platform, pair), right = compose(left, scenes::Pose{spec.baseline_m, 0, 0});
  struct Seen {
    int landmark;
    double alpha, beta;
  };
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto a = direction(caster, left, edges[i], radii_m[i], spec.reach_m),
               b = direction(caster, right, edges[i], radii_m[i], spec.reach_m);
    if (!a || !b) continue;
    const raycast::NoiseKey key{seed, 0, static_cast<std::uint32_t>(i), stop};
    seen.push_back({static_cast<int>(i), *a - left.yaw_rad + spec.sigma_rad * raycast::gaussian(key, 0),
                    *b - left.yaw_rad + spec.sigma_rad * raycast::gaussian(key, 1)});
  }
  Acquisition out;
  for (const Seen& s : seen) out.edges.push_back(s.landmark);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const raycast::NoiseKey key{seed, 1, static_cast<std::uint32_t>(seen[i].landmark), stop};
    const bool wrong = seen.size() > 1 && unit(key, 0) < spec.false_share;
    std::size_t other = i;
    if (wrong)
      other = (i + 1 + static_cast<std::size_t>(unit(key, 1) * static_cast<double>(seen.size() - 1))) % seen.size();
    const double low = wrong ? spec.false_low : spec.true_low, high = wrong ? spec.false_high : spec.true_high;
    const double alpha = seen[i].alpha, beta = seen[other].beta, w = spec.half_width_rad;
    // The visibility rule of figure 5: rays that meet behind the cameras cannot be of one object.
    const double turn = std::remainder(beta - alpha, 2 * std::numbers::pi);
    Primitive p;
    if (!triangulate({alpha - w, alpha + w}, {alpha + turn - w, alpha + turn + w}, spec.baseline_m, p.x, p.y)) {
      ++out.parallel;
      continue;
    }
    const double ahead = p.x.middle() * std::cos(alpha) + p.y.middle() * std::sin(alpha);
    if (ahead <= 0) continue;
    if (p.x.width() > spec.widest_m || p.y.width() > spec.widest_m || ahead > spec.reach_m) {
      ++out.too_wide;
      continue;
    }
    // From the pair's frame to the platform's: x' = y, y' = baseline/2 − x.
    const Interval along = p.y, across{spec.baseline_m / 2 - p.x.high, spec.baseline_m / 2 - p.x.low};
    p.x = along, p.y = across;
    p.exists = existence_of_match(low + (high - low) * unit(key, 2));
    p.landmark = wrong ? -1 : seen[i].landmark;
    out.primitives.push_back(p);
  }
  return out;
}

}  // namespace evigrid::driver
