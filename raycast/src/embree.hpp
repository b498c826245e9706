// SPDX-License-Identifier: Apache-2.0
// The only place that knows which Embree this is. Version 4 moved the ray context into an argument structure; both are
// used here through the same names. `valid`: −1 for each ray of a packet that is asked, else 0; `coherent` rays start
// at one point and look nearly the same way. Masks are set by hand, since the default of a geometry's mask changed.
#pragma once
#include <xmmintrin.h>

#include <memory>
#include <type_traits>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace evigrid::raycast::embree {

#if RTC_VERSION_MAJOR >= 4
using RayContext = RTCRayQueryContext;
inline void init(RayContext& context) { rtcInitRayQueryContext(&context); }
inline void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
inline void intersect(RTCScene scene, RayContext& context, const int* valid, RTCRayHit16& rays, bool coherent) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
}
#else
using RayContext = RTCIntersectContext;
inline void init(RayContext& context) { rtcInitIntersectContext(&context); }
inline void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray) { rtcIntersect1(scene, &context, &ray); }
inline void intersect(RTCScene scene, RayContext& context, const int* valid, RTCRayHit16& rays, bool coherent) {
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
}
#endif

inline constexpr unsigned kEveryMask = 0xffffffffu;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release>;

/// Embree asks for flush-to-zero and denormals-are-zero in the calling thread. The caller of the library did not: their
/// modes come back when the task ends.
class FlushToZero {
 public:
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushToZero() { _mm_setcsr(saved_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  unsigned saved_;
};

}  // namespace evigrid::raycast::embree
