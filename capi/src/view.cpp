// SPDX-License-Identifier: Apache-2.0
// Views: what is read; and the batched algebra.
#include <algorithm>

#include "handles.hpp"

using namespace evigrid;
using capi::guarded, capi::need, capi::rect;

namespace {

template <class T>
void render_costs(const evigrid_view* view, const Costmap& costs, evigrid_rect area, T* out, size_t count,
                  ptrdiff_t stride) {
  const MapView& v = need(view, "view").view;
  if (count > 0) need(out, "out");
  v.render(costs, rect(area), std::span(out, count), stride);
}

Planes<const float> source(const evigrid_planes& p, size_t n, const char* name) {
  if (n > 0 && (p.e == nullptr || p.o == nullptr || p.u == nullptr)) {
    throw std::invalid_argument(std::string(name) + " needs e, o and u");
  }
  return {p.e, p.o, p.u, p.c};
}

}  // namespace

evigrid_status evigrid_map_view(evigrid_map* map, evigrid_view** out) {
  return guarded([&] {
    need(out, "out");
    *out = new evigrid_view{need(map, "map").map.view()};
  });
}
evigrid_status evigrid_view_copy(const evigrid_view* view, evigrid_view** out) {
  return guarded([&] {
    need(out, "out");
    *out = new evigrid_view{need(view, "view").view};
  });
}
void evigrid_view_destroy(evigrid_view* view) { delete view; }

evigrid_status evigrid_view_version(const evigrid_view* view, uint64_t* version) {
  return guarded([&] { need(version, "version") = need(view, "view").view.version(); });
}
evigrid_status evigrid_view_hash(const evigrid_view* view, uint64_t* hash) {
  return guarded([&] { need(hash, "hash") = need(view, "view").view.hash(); });
}
evigrid_status evigrid_view_cell_m(const evigrid_view* view, double* cell_m) {
  return guarded([&] { need(cell_m, "cell_m") = need(view, "view").view.params().cell_m; });
}
evigrid_status evigrid_view_bounds(const evigrid_view* view, evigrid_rect* bounds) {
  return guarded([&] { need(bounds, "bounds") = rect(need(view, "view").view.bounds()); });
}
evigrid_status evigrid_view_cell_at(const evigrid_view* view, double x_m, double y_m, evigrid_cell* cell) {
  return guarded([&] {
    const CellIndex at = need(view, "view").view.cell_at(x_m, y_m);
    need(cell, "cell") = {at.x, at.y};
  });
}
evigrid_status evigrid_view_mass(const evigrid_view* view, evigrid_cell cell, evigrid_mass* mass) {
  return guarded([&] {
    const Mass m = need(view, "view").view.mass({cell.x, cell.y});
    need(mass, "mass") = {m.e, m.o, m.u, m.c};
  });
}

evigrid_status evigrid_view_render(const evigrid_view* view, const char* layer, evigrid_rect area, float* out,
                                   size_t count, ptrdiff_t stride) {
  return guarded([&] {
    const MapView& v = need(view, "view").view;
    const auto which = layer_from_name(&need(layer, "layer"));
    if (!which) throw std::invalid_argument("no layer is called \"" + std::string(layer) + "\"");
    if (count > 0) need(out, "out");
    v.render(*which, rect(area), std::span(out, count), stride);
  });
}
evigrid_status evigrid_view_render_occupancy(const evigrid_view* view, double free_below, double lethal_above,
                                             double max_unknown, evigrid_rect area, int8_t* out, size_t count,
                                             ptrdiff_t stride) {
  return guarded([&] { render_costs(view, {free_below, lethal_above, max_unknown}, area, out, count, stride); });
}
evigrid_status evigrid_view_render_cost(const evigrid_view* view, double free_below, double lethal_above,
                                        double max_unknown, evigrid_rect area, uint8_t* out, size_t count,
                                        ptrdiff_t stride) {
  return guarded([&] { render_costs(view, {free_below, lethal_above, max_unknown}, area, out, count, stride); });
}

evigrid_status evigrid_view_changes(const evigrid_view* view, uint64_t since, evigrid_rect* rects, size_t capacity,
                                    size_t* count, int* cleared) {
  return guarded([&] {
    const Changes changes = need(view, "view").view.changes(since);
    if (capacity > 0) need(rects, "rects");
    const size_t n = std::min(capacity, changes.rects.size());
    for (size_t i = 0; i < n; ++i) rects[i] = rect(changes.rects[i]);
    if (count != nullptr) *count = changes.rects.size();
    if (cleared != nullptr) *cleared = changes.cleared ? 1 : 0;
  });
}
evigrid_status evigrid_view_save(const evigrid_view* view, const char* path) {
  return guarded([&] { save(need(view, "view").view, &need(path, "path")); });
}

evigrid_status evigrid_combine(const char* rule, evigrid_planes a, evigrid_planes b, evigrid_planes out,
                               float* conflict, size_t n, int threads, uint64_t* total_conflicts) {
  return guarded([&] {
    const auto which = rule_from_name(&need(rule, "rule"));
    if (!which) throw std::invalid_argument("no rule is called \"" + std::string(rule) + "\"");
    if (threads < 0) throw std::invalid_argument("threads must not be negative");
    source(out, n, "out");
    const auto executor = threads == 1 ? nullptr : make_tbb_executor(threads);
    const std::uint64_t total =
        combine(*which, source(a, n, "a"), source(b, n, "b"), Planes<float>{out.e, out.o, out.u, out.c}, conflict, n,
                Kernel::automatic, executor.get());
    if (total_conflicts != nullptr) *total_conflicts = total;
  });
}
