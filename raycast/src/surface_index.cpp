// SPDX-License-Identifier: Apache-2.0
#include "surface_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "embree.hpp"
#include "wedge.hpp"

namespace evigrid::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Rounding of float coordinates of this size, several times over.
constexpr double kFloatMargin = 1e-6;

struct Bounds {
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  void add(Vec2 p, double reach) {
    low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach)};
    high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach)};
  }
};

Bounds bounds_of(const Surface& s) {
  Bounds b;
  b.add(s.a, s.radius);
  if (s.kind == Surface::Kind::segment) b.add(s.b, 0);
  return b;
}

struct RayTask : embree::RayContext {
  Vec2 origin, direction;
  double best_m;
  double skipped_m;  ///< the ray that Embree sees starts this far along
};

struct PointTask {
  SurfaceIndex::Visitor* visitor;
  double radius_m, margin_m;
  std::exception_ptr failure;
};

}  // namespace

struct SurfaceIndex::Tree {
  embree::Device device;
  embree::Scene scene;

  static void bounds(const RTCBoundsFunctionArguments* args) {
    const auto& index = *static_cast<const SurfaceIndex*>(args->geometryUserPtr);
    const Bounds b = bounds_of(index.surfaces_[args->primID]);
    const double margin = kFloatMargin * (1 + index.radius_m_);
    RTCBounds& out = *args->bounds_o;
    out.lower_x = static_cast<float>(b.low.x - index.centre_.x - margin);
    out.lower_y = static_cast<float>(b.low.y - index.centre_.y - margin);
    out.upper_x = static_cast<float>(b.high.x - index.centre_.x + margin);
    out.upper_y = static_cast<float>(b.high.y - index.centre_.y + margin);
    out.lower_z = -1;
    out.upper_z = 1;
  }

  static void intersect(const RTCIntersectFunctionNArguments* args) {
    // Only single rays are cast, so there is one ray here, and the whole context belongs to it.
    if (!args->valid[0]) return;
    const auto& index = *static_cast<const SurfaceIndex*>(args->geometryUserPtr);
    RayTask& task = *static_cast<RayTask*>(args->context);
    const double hit = hit_distance(seen_from(index.surfaces_[args->primID], task.origin), task.direction);
    if (hit > task.best_m) return;
    task.best_m = hit;
    const double margin = kFloatMargin * (1 + index.radius_m_);
    RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
    RTCRayN_tfar(ray, args->N, 0) = static_cast<float>(hit - task.skipped_m + margin);
    RTCHitN_geomID(RTCRayHitN_HitN(args->rayhit, args->N), args->N, 0) = args->geomID;
  }

  /// An exception must not pass through Embree: it waits here, and the query is cut short.
  static bool visit(RTCPointQueryFunctionArguments* args) {
    PointTask& task = *static_cast<PointTask*>(args->userPtr);
    if (task.failure) return false;
    try {
      const double radius = task.visitor->visit(args->primID, task.radius_m);
      if (radius >= task.radius_m) return false;
      task.radius_m = radius;
    } catch (...) {
      task.failure = std::current_exception();
      task.radius_m = 0;
    }
    args->query->radius = std::min(args->query->radius, static_cast<float>(task.radius_m + task.margin_m));
    return true;
  }
};

SurfaceIndex::SurfaceIndex(std::vector<Surface> surfaces)
    : surfaces_(std::move(surfaces)), tree_(std::make_unique<Tree>()) {
  Bounds all;
  for (const Surface& s : surfaces_) {
    const Bounds b = bounds_of(s);
    all.add(b.low, 0);
    all.add(b.high, 0);
  }
  if (surfaces_.empty()) return;
  centre_ = 0.5 * (all.low + all.high);
  radius_m_ = 0.5 * length(all.high - all.low);

  const embree::FlushToZero scope;
  const auto check = [&](bool good) {
    if (good && rtcGetDeviceError(tree_->device.get()) == RTC_ERROR_NONE) return;
    throw std::runtime_error("the ray caster (Embree) cannot build the scene");
  };
  tree_->device.reset(rtcNewDevice(nullptr));  // no options: thread counts are process-wide
  check(tree_->device != nullptr);
  tree_->scene.reset(rtcNewScene(tree_->device.get()));
  rtcSetSceneFlags(tree_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree_->scene.get(), RTC_BUILD_QUALITY_HIGH);
  const embree::Geometry geometry(rtcNewGeometry(tree_->device.get(), RTC_GEOMETRY_TYPE_USER));
  check(geometry != nullptr);
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(surfaces_.size()));
  rtcSetGeometryUserData(geometry.get(), this);
  rtcSetGeometryMask(geometry.get(), embree::kEveryMask);
  rtcSetGeometryBoundsFunction(geometry.get(), Tree::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), Tree::intersect);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(tree_->scene.get(), geometry.get());
  rtcCommitScene(tree_->scene.get());
  check(true);
}

SurfaceIndex::~SurfaceIndex() = default;

void SurfaceIndex::visit_near(Vec2 point, double radius_m, Visitor& visitor) const {
  if (surfaces_.empty()) return;
  const Vec2 p = point - centre_;
  PointTask task{&visitor, radius_m, kFloatMargin * (1 + radius_m_ + length(p)), nullptr};
  {
    const embree::FlushToZero scope;
    RTCPointQuery query{};
    query.x = static_cast<float>(p.x);
    query.y = static_cast<float>(p.y);
    query.radius = static_cast<float>(radius_m + task.margin_m);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(tree_->scene.get(), &query, &context, Tree::visit, &task);
  }
  if (task.failure) std::rethrow_exception(task.failure);
}

double SurfaceIndex::first_hit(Vec2 origin, Vec2 direction, double max_range_m) const {
  if (surfaces_.empty()) return kInfinity;
  // From far away the ray starts where the surfaces begin: float coordinates stay small.
  const double skipped = std::max(0.0, dot(centre_ - origin, direction) - radius_m_ - 1);
  const Vec2 start = origin + skipped * direction - centre_;
  RayTask task;
  embree::init(task);
  task.origin = origin;
  task.direction = direction;
  task.best_m = kInfinity;
  task.skipped_m = skipped;
  const double end = std::min(max_range_m - skipped, length(start) + radius_m_) + kFloatMargin * (1 + radius_m_);
  if (end <= 0 || length(start) > 4 * radius_m_ + 4) return kInfinity;  // passes by at a distance
  const embree::FlushToZero scope;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x);
  ray.ray.org_y = static_cast<float>(start.y);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.tfar = static_cast<float>(end);
  ray.ray.mask = embree::kEveryMask;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(tree_->scene.get(), task, ray);
  return task.best_m <= max_range_m ? task.best_m : kInfinity;
}

}  // namespace evigrid::raycast
