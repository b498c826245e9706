// SPDX-License-Identifier: Apache-2.0
// Maps: what is written, and files.
#include <algorithm>
#include <vector>

#include "handles.hpp"

using namespace evigrid;
using capi::guarded, capi::need, capi::pose, capi::rect;

namespace {

static_assert(kRefusalCount <= EVIGRID_REFUSALS);

std::vector<Reading> readings_of(const evigrid_reading* readings, size_t count) {
  if (count > 0) need(readings, "readings");
  std::vector<Reading> out;
  out.reserve(count);
  for (const evigrid_reading& r : std::span(readings, count)) {
    if (r.count > 0) need(r.ranges_m, "readings[].ranges_m");
    out.push_back({r.sensor, std::span(r.ranges_m, r.count)});
  }
  return out;
}

void fill(evigrid_report* out, const Report& r) noexcept {
  if (out == nullptr) return;
  *out = {};
  out->readings_used = r.readings_used;
  out->readings_clipped = r.readings_clipped;
  out->stamps_backwards = r.stamps_backwards;
  out->cells_updated = r.cells_updated;
  out->total_conflicts = r.total_conflicts;
  std::copy(r.refused.begin(), r.refused.end(), out->refused);
  out->max_conflict = r.max_conflict;
  out->touched = rect(r.touched);
}

}  // namespace

evigrid_status evigrid_map_create(const evigrid_params* params, evigrid_map** out) {
  return guarded([&] {
    need(out, "out");
    const evigrid_params standard, &p = params == nullptr ? standard : *params;
    *out = new evigrid_map{Map(p.map, p.make_executor())};
  });
}
void evigrid_map_destroy(evigrid_map* map) { delete map; }

evigrid_status evigrid_map_add_sensor(evigrid_map* map, const evigrid_sensor* sensor, uint32_t* id) {
  return guarded([&] {
    const SensorId added = need(map, "map").map.add(need(sensor, "sensor").sensor);
    if (id != nullptr) *id = added;
  });
}

evigrid_status evigrid_map_integrate(evigrid_map* map, int64_t stamp_ns, evigrid_pose T_map_robot,
                                     const evigrid_reading* readings, size_t count, evigrid_report* report) {
  return guarded([&] {
    Map& m = need(map, "map").map;
    const auto list = readings_of(readings, count);
    fill(report, m.integrate({stamp_ns, pose(T_map_robot), list}));
  });
}
evigrid_status evigrid_map_undo(evigrid_map* map, int64_t stamp_ns, evigrid_pose T_map_robot,
                                const evigrid_reading* readings, size_t count, evigrid_report* report) {
  return guarded([&] {
    Map& m = need(map, "map").map;
    const auto list = readings_of(readings, count);
    fill(report, m.undo({stamp_ns, pose(T_map_robot), list}));
  });
}

evigrid_status evigrid_map_advance_to(evigrid_map* map, int64_t stamp_ns) {
  return guarded([&] { need(map, "map").map.advance_to(stamp_ns); });
}
evigrid_status evigrid_map_page_to(evigrid_map* map, const char* directory) {
  return guarded([&] { need(map, "map").map.page_to(&need(directory, "directory")); });
}
evigrid_status evigrid_map_paged(const evigrid_map* map, size_t* bytes) {
  return guarded([&] { need(bytes, "bytes") = need(map, "map").map.paged_bytes(); });
}
evigrid_status evigrid_map_clear(evigrid_map* map) {
  return guarded([&] { need(map, "map").map.clear(); });
}
evigrid_status evigrid_map_clear_rect(evigrid_map* map, evigrid_rect area) {
  return guarded([&] { need(map, "map").map.clear(rect(area)); });
}
evigrid_status evigrid_map_set_window(evigrid_map* map, evigrid_rect window) {
  return guarded([&] { need(map, "map").map.set_window(rect(window)); });
}
evigrid_status evigrid_map_protect(evigrid_map* map, evigrid_rect area) {
  return guarded([&] { need(map, "map").map.protect(rect(area)); });
}
evigrid_status evigrid_map_unprotect(evigrid_map* map) {
  return guarded([&] { need(map, "map").map.unprotect(); });
}

evigrid_status evigrid_map_write(evigrid_map* map, evigrid_rect area, const evigrid_mass* masses, size_t count,
                                 ptrdiff_t stride) {
  return guarded([&] {
    Map& m = need(map, "map").map;
    if (count > 0) need(masses, "masses");
    std::vector<Mass> copy;
    copy.reserve(count);
    for (const evigrid_mass& c : std::span(masses, count)) copy.push_back({c.e, c.o, c.u, c.c});
    m.write(rect(area), copy, stride);
  });
}
evigrid_status evigrid_map_write_occupancy(evigrid_map* map, evigrid_rect area, const int8_t* occupancy, size_t count,
                                           ptrdiff_t stride, double certainty) {
  return guarded([&] {
    Map& m = need(map, "map").map;
    if (count > 0) need(occupancy, "occupancy");
    m.write(rect(area), std::span(occupancy, count), stride, certainty);
  });
}

evigrid_status evigrid_map_hash(const evigrid_map* map, uint64_t* hash) {
  return guarded([&] { need(hash, "hash") = need(map, "map").map.hash(); });
}
evigrid_status evigrid_map_memory(const evigrid_map* map, size_t* bytes, size_t* tiles) {
  return guarded([&] {
    const Map& m = need(map, "map").map;
    if (bytes != nullptr) *bytes = m.memory_bytes();
    if (tiles != nullptr) *tiles = m.tiles();
  });
}
const char* evigrid_map_kernel(const evigrid_map* map) { return map == nullptr ? "" : map->map.kernel_name().data(); }

evigrid_status evigrid_map_save(const evigrid_map* map, const char* path) {
  return guarded([&] { save(need(map, "map").map, &need(path, "path")); });
}
evigrid_status evigrid_map_load(const char* path, const evigrid_params* params, evigrid_map** out) {
  return guarded([&] {
    need(path, "path");
    need(out, "out");
    const evigrid_params standard, &p = params == nullptr ? standard : *params;
    LoadOptions options{.executor = p.make_executor()};
    if (p.kernel_asked) options.kernel = p.map.kernel;
    if (p.cap_asked) options.memory_cap_bytes = p.map.memory_cap_bytes;
    *out = new evigrid_map{load(path, options)};
  });
}

evigrid_status evigrid_map_merge(evigrid_map* into, const evigrid_view* from, evigrid_pose T_into_from,
                                 double reliability, uint64_t* cells) {
  return guarded([&] {
    const MergeReport r = merge(need(into, "into").map, need(from, "from").view, {pose(T_into_from), reliability});
    if (cells != nullptr) *cells = r.cells;
  });
}
