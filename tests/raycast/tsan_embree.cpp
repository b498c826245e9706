// SPDX-License-Identifier: Apache-2.0
// Embree and oneTBB come without instrumentation, so ThreadSanitizer cannot see how they order their own work and would
// report it. Ignored are calls that come directly from these two libraries, and the building of a scene, which no other
// thread of ours can see yet; queries and their callbacks are still watched. Ignored as well is what runs in blocks on
// TBB, whose handing over of a task cannot be seen: the same casts are watched on plain threads. Linked into every test
// that casts; empty without ThreadSanitizer.
#if defined(__SANITIZE_THREAD__)
#define EVIGRID_TSAN 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define EVIGRID_TSAN 1
#endif
#endif

#ifdef EVIGRID_TSAN
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libembree3.so\n"
         "called_from_lib:libtbb.so\n"
         "race:evigrid::raycast::SurfaceIndex::Tree::bounds\n"
         "race:evigrid::raycast::for_each_block\n"
         "race:evigrid::raycast::Scene::Scene\n";
}
#endif
