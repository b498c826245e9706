// SPDX-License-Identifier: Apache-2.0
#include "surface_index.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <limits>

#include "embree.hpp"
#include "embree_device.hpp"

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
  const Rays* rays;
  Hits* hits;
  const double* skipped_m;              ///< the ray that Embree sees starts this far along
  const RTCRayHit16* packet = nullptr;  ///< as it was given to Embree, if it was one
};

struct PointTask {
  SurfaceIndex::Visitor* visitor;
  const Surface* surfaces;
  double radius_m, margin_m;
  std::exception_ptr failure;
};

}  // namespace

struct SurfaceIndex::Tree {
  embree::Scene scene;

  static void bounds(const RTCBoundsFunctionArguments* args) {
    const auto& index = *static_cast<const SurfaceIndex*>(args->geometryUserPtr);
    const Bounds b = bounds_of(index.surfaces_[args->primID]);
    const double margin = index.margin_m_;
    RTCBounds& out = *args->bounds_o;
    out.lower_x = static_cast<float>(b.low.x - index.centre_.x - margin);
    out.lower_y = static_cast<float>(b.low.y - index.centre_.y - margin);
    out.upper_x = static_cast<float>(b.high.x - index.centre_.x + margin);
    out.upper_y = static_cast<float>(b.high.y - index.centre_.y + margin);
    out.lower_z = -1;
    out.upper_z = 1;
  }

  /// Embree may hand over any part of a packet in any width: the rays carry their lane as their id.
  static void intersect(const RTCIntersectFunctionNArguments* args) {
    const auto& index = *static_cast<const SurfaceIndex*>(args->geometryUserPtr);
    const RayTask& task = *static_cast<const RayTask*>(args->context);
    const unsigned n = args->N;
    RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, n);
    const bool whole = args->rayhit == static_cast<const void*>(task.packet);  // then lane i is ray i
    Lanes asked = 0;
    for (unsigned i = 0; i < n; ++i)
      asked |= (args->valid[i] != 0 ? Lanes{1} : Lanes{0}) << (whole ? i : RTCRayN_id(ray, n, i));
    const Surface& surface = index.surfaces_[args->primID];
    const Lanes changed = meet(surface, name_of(index.owner_, args->primID), *task.rays, asked, *task.hits);
    if (changed == 0) return;
    const auto shorten = [&](unsigned i, unsigned k) {
      RTCRayN_tfar(ray, n, i) = static_cast<float>(task.hits->first_m[k] - task.skipped_m[k] + index.margin_m_);
    };
    if (whole) {
      for (Lanes rest = changed; rest != 0; rest &= rest - 1) {
        const auto k = static_cast<unsigned>(std::countr_zero(rest));
        shorten(k, k);
      }
      return;
    }
    for (unsigned i = 0; i < n; ++i) {
      const unsigned k = RTCRayN_id(ray, n, i);
      if (args->valid[i] != 0 && (changed >> k & 1) != 0) shorten(i, k);
    }
  }

  /// An exception must not pass through Embree: it waits here, and the query is cut short.
  static bool visit(RTCPointQueryFunctionArguments* args) {
    PointTask& task = *static_cast<PointTask*>(args->userPtr);
    if (task.failure) return false;
    try {
      const double radius = task.visitor->visit(task.surfaces[args->primID], args->primID, task.radius_m);
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

SurfaceIndex::SurfaceIndex(std::vector<Surface> surfaces, std::uint32_t owner, bool list_few, EmbreeDevice& device)
    : surfaces_(std::move(surfaces)), owner_(owner) {
  Bounds all;
  for (const Surface& s : surfaces_) {
    const Bounds b = bounds_of(s);
    all.add(b.low, 0);
    all.add(b.high, 0);
    reach_m_ = std::max({reach_m_, length(s.a) + s.radius, s.kind == Surface::Kind::segment ? length(s.b) : 0});
  }
  if (surfaces_.empty()) return;
  centre_ = 0.5 * (all.low + all.high);
  radius_m_ = 0.5 * length(all.high - all.low);
  margin_m_ = kFloatMargin * (1 + radius_m_);
  if (list_few && surfaces_.size() <= kFew) return;

  const embree::FlushToZero scope;
  tree_ = std::make_unique<Tree>();
  tree_->scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(tree_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree_->scene.get(), RTC_BUILD_QUALITY_HIGH);
  const embree::Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
  device.check(geometry != nullptr);
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(surfaces_.size()));
  rtcSetGeometryUserData(geometry.get(), this);
  rtcSetGeometryMask(geometry.get(), embree::kEveryMask);
  rtcSetGeometryBoundsFunction(geometry.get(), Tree::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), Tree::intersect);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(tree_->scene.get(), geometry.get());
  rtcCommitScene(tree_->scene.get());
  device.check(true);
}

SurfaceIndex::~SurfaceIndex() = default;

void SurfaceIndex::visit_near(Vec2 point, double radius_m, Visitor& visitor) const {
  if (!tree_) {
    for (std::uint32_t i = 0; i < surfaces_.size(); ++i) radius_m = visitor.visit(surfaces_[i], i, radius_m);
    return;
  }
  const Vec2 p = point - centre_;
  PointTask task{&visitor, surfaces_.data(), radius_m, kFloatMargin * (1 + radius_m_ + length(p)), nullptr};
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

void SurfaceIndex::first_hits(const Rays& rays, Lanes asked, Hits& hits) const {
  if (!tree_) {
    for (std::uint32_t i = 0; i < surfaces_.size(); ++i) meet(surfaces_[i], name_of(owner_, i), rays, asked, hits);
  } else if (std::has_single_bit(asked)) {
    cast_one(rays, std::countr_zero(asked), hits);
  } else if (asked != 0) {
    cast_packet(rays, asked, hits);
  }
}

/// The part of a ray that Embree is asked about, relative to the centre. From far away it starts where the surfaces
/// begin, so that float coordinates stay small; a ray that passes by at a distance is empty (end_m <= 0).
struct SurfaceIndex::Stretch {
  Vec2 start;
  double skipped_m = 0, end_m = 0;
};

SurfaceIndex::Stretch SurfaceIndex::stretch_of(Vec2 origin, Vec2 direction, double limit_m) const {
  const Vec2 from = origin - centre_;
  Stretch s;
  s.skipped_m = std::max(0.0, -dot(from, direction) - radius_m_ - 1);
  s.start = from + s.skipped_m * direction;
  const double distance = length(s.start);
  if (distance > 4 * radius_m_ + 4) return s;
  s.end_m = std::min(limit_m - s.skipped_m, distance + radius_m_) + margin_m_;
  return s;
}

void SurfaceIndex::cast_one(const Rays& rays, int k, Hits& hits) const {
  const Vec2 direction = rays.direction(k);
  const Stretch stretch = stretch_of(rays.origin(k), direction, hits.first_m[k]);
  if (stretch.end_m <= 0) return;
  double skipped_m[kPacket];
  skipped_m[k] = stretch.skipped_m;
  RayTask task;
  embree::init(task);
  task.rays = &rays;
  task.hits = &hits;
  task.skipped_m = skipped_m;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(stretch.start.x);
  ray.ray.org_y = static_cast<float>(stretch.start.y);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.tfar = static_cast<float>(stretch.end_m);
  ray.ray.mask = embree::kEveryMask;
  ray.ray.id = static_cast<unsigned>(k);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  const embree::FlushToZero scope;
  embree::intersect(tree_->scene.get(), task, ray);
}

void SurfaceIndex::cast_packet(const Rays& rays, Lanes asked, Hits& hits) const {
  alignas(64) double skipped_m[kPacket];
  alignas(64) int valid[kPacket];
  RTCRayHit16 ray;
  const auto begin = [&](int k, const Stretch& s) {
    valid[k] = (asked >> k & 1) != 0 && s.end_m > 0 ? -1 : 0;
    skipped_m[k] = s.skipped_m;
    ray.ray.org_x[k] = static_cast<float>(s.start.x);
    ray.ray.org_y[k] = static_cast<float>(s.start.y);
    ray.ray.tfar[k] = static_cast<float>(s.end_m);
  };
  const bool whole = rays.one_origin;  // then all lanes hold a ray
  const Vec2 from = whole ? rays.origin(0) - centre_ : Vec2{};
  if (whole && dot(from, from) <= (radius_m_ + 1) * (radius_m_ + 1)) {  // nothing to skip
    const double farthest = length(from) + radius_m_;
    for (int k = 0; k < kPacket; ++k) begin(k, {from, 0, std::min(hits.first_m[k], farthest) + margin_m_});
  } else {
    for (int k = 0; k < kPacket; ++k)
      begin(k, (asked >> k & 1) != 0 ? stretch_of(rays.origin(k), rays.direction(k), hits.first_m[k]) : Stretch());
  }
  for (int k = 0; k < kPacket; ++k) {
    ray.ray.org_z[k] = 0;
    const bool here = whole || (asked >> k & 1) != 0;
    ray.ray.dir_x[k] = here ? static_cast<float>(rays.direction_x[k]) : 1;
    ray.ray.dir_y[k] = here ? static_cast<float>(rays.direction_y[k]) : 0;
    ray.ray.dir_z[k] = 0;
    ray.ray.tnear[k] = 0;
    ray.ray.time[k] = 0;
    ray.ray.mask[k] = embree::kEveryMask;
    ray.ray.id[k] = static_cast<unsigned>(k);
    ray.ray.flags[k] = 0;
    ray.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  RayTask task;
  embree::init(task);
  task.rays = &rays;
  task.hits = &hits;
  task.skipped_m = skipped_m;
  task.packet = &ray;
  const embree::FlushToZero scope;
  embree::intersect(tree_->scene.get(), task, valid, ray, rays.one_origin);
}

}  // namespace evigrid::raycast
