/* SPDX-License-Identifier: Apache-2.0 */
/* evigrid from C, and from everything that calls C: evidential occupancy grids.
 *
 * Objects are opaque; what _create, _load, _view and _copy give is given back with _destroy, which takes NULL. Every
 * call that can fail returns a status; evigrid_last_error() says what was wrong, in the calling thread, naming the
 * field or the file. Nothing is thrown, printed or aborted; out parameters are written on success alone. Settings are
 * named as in the C++ headers, so that this interface needs no change where those grow.
 *
 * Metres, radians, nanoseconds. Cell (x, y) covers [x·c, (x+1)·c) × [y·c, (y+1)·c) of the map frame, c = cell_m; the
 * grid has no origin and no border. Masses are e (empty), o (occupied), u (unknown) and c (conflict that the rule
 * keeps); they add up to 1 (but for the rule fuzzy, whose e and o are memberships), a cell never seen is (0, 0, 1, 0).
 *
 * One thread at a time may write a map, and no other may read it then; views are read by any number of threads, while
 * the map goes on. */
#ifndef EVIGRID_H
#define EVIGRID_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define EVIGRID_C_API __attribute__((visibility("default")))
#else
#define EVIGRID_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum evigrid_status {
  EVIGRID_OK = 0,
  EVIGRID_INVALID = 1,     /**< a null pointer, an unknown name, a value out of range */
  EVIGRID_LIMIT = 2,       /**< the map's memory cap */
  EVIGRID_FILE = 3,        /**< cannot be read or written, or is no map */
  EVIGRID_UNSUPPORTED = 4, /**< not with this rule, or not on this machine */
  EVIGRID_MEMORY = 5,      /**< the system gave no memory */
  EVIGRID_INTERNAL = 6     /**< a defect of ours: please report it */
} evigrid_status;

/** What was wrong with the last call of this thread that failed; "" before the first. Valid until the next one. */
EVIGRID_C_API const char *evigrid_last_error(void);
EVIGRID_C_API const char *evigrid_status_name(evigrid_status status);
/** "0.1.0" */
EVIGRID_C_API const char *evigrid_version(void);
/** Raised when a change alters the bits of a map. */
EVIGRID_C_API int evigrid_maths_version(void);
/** Names by index, NULL beyond the last: rules, models, layers, reasons of refusal. */
EVIGRID_C_API const char *evigrid_rule_name(size_t index);
EVIGRID_C_API const char *evigrid_model_name(size_t index);
EVIGRID_C_API const char *evigrid_layer_name(size_t index);
EVIGRID_C_API const char *evigrid_refusal_name(size_t index);

typedef struct evigrid_pose {
  double x_m, y_m, yaw_rad;
} evigrid_pose;
typedef struct evigrid_cell {
  int64_t x, y;
} evigrid_cell;
/** Half-open: x … x + width − 1, y … y + height − 1. Empty when width or height is 0. */
typedef struct evigrid_rect {
  int64_t x, y, width, height;
} evigrid_rect;
typedef struct evigrid_mass {
  float e, o, u, c;
} evigrid_mass;

/* ------------------------------------------------------------------------------------------------- settings */

/** What a map is made with. Numbers: cell_m, keep_conflict, keep_con, keep_last_conflict (0 or 1), memory_cap_bytes,
 * false_reflection_m, decay_s, bayes.least_p, bayes.most_p, threads (0: all of the machine). Texts: rule, kernel
 * ("auto", "scalar", "avx2", "avx512", "cuda"), executor ("tbb", "openmp", "spin", "serial"), bayes.likelihood
 * ("betp", "plp"). */
typedef struct evigrid_params evigrid_params;
EVIGRID_C_API evigrid_status evigrid_params_create(evigrid_params **out);
EVIGRID_C_API void evigrid_params_destroy(evigrid_params *params);
EVIGRID_C_API evigrid_status evigrid_params_set_number(evigrid_params *params, const char *name, double value);
EVIGRID_C_API evigrid_status evigrid_params_set_text(evigrid_params *params, const char *name, const char *value);

/** A sensor: a sonar cone, or with the model "beam" a fan of laser beams. Numbers: x_m, y_m, yaw_rad (the mount, in the
 * robot's frame), aperture_rad, min_range_m, max_range_m, no_return_m, clear_no_return (0 or 1), reliability,
 * reliability_if_empty, reliability_if_occupied, decay_s, weight_exponent, beams, first_beam_rad, beam_step_rad, and the
 * parameters of its model, e.g. rho_e of li2014. Text: dependence. Values are checked when a map takes the sensor. */
typedef struct evigrid_sensor evigrid_sensor;
EVIGRID_C_API evigrid_status evigrid_sensor_create(const char *model, evigrid_sensor **out);
EVIGRID_C_API void evigrid_sensor_destroy(evigrid_sensor *sensor);
EVIGRID_C_API evigrid_status evigrid_sensor_set_number(evigrid_sensor *sensor, const char *name, double value);
EVIGRID_C_API evigrid_status evigrid_sensor_set_text(evigrid_sensor *sensor, const char *name, const char *value);

/* ------------------------------------------------------------------------------------------------------ maps */

typedef struct evigrid_map evigrid_map;
/** params may be NULL: 5 cm, PCR5, all threads. */
EVIGRID_C_API evigrid_status evigrid_map_create(const evigrid_params *params, evigrid_map **out);
EVIGRID_C_API void evigrid_map_destroy(evigrid_map *map);
/** The map keeps a copy. Sensors are numbered from 0 in the order they are added. */
EVIGRID_C_API evigrid_status evigrid_map_add_sensor(evigrid_map *map, const evigrid_sensor *sensor, uint32_t *id);

/** One measurement: one range of a cone, all ranges of a fan. REP 117: +inf nothing in range, -inf too close, NaN
 * invalid. */
typedef struct evigrid_reading {
  uint32_t sensor;
  const float *ranges_m;
  size_t count;
} evigrid_reading;

#define EVIGRID_REFUSALS 16 /**< room for reasons to come; evigrid_refusal_name() names those there are */
typedef struct evigrid_report {
  uint64_t readings_used, readings_clipped, stamps_backwards;
  uint64_t cells_updated, total_conflicts;
  uint64_t refused[EVIGRID_REFUSALS]; /**< by reason: none is dropped silently */
  double max_conflict;                /**< largest k of one update */
  evigrid_rect touched;               /**< box of the tiles that readings reached */
} evigrid_report;

/** Fuses the readings of one robot at one time. report may be NULL. EVIGRID_LIMIT leaves the map as it was. */
EVIGRID_C_API evigrid_status evigrid_map_integrate(evigrid_map *map, int64_t stamp_ns, evigrid_pose T_map_robot,
                                                   const evigrid_reading *readings, size_t count,
                                                   evigrid_report *report);
/** Takes a scan back that was integrated before: rules whose cells are sums (dempster_log, murphy). */
EVIGRID_C_API evigrid_status evigrid_map_undo(evigrid_map *map, int64_t stamp_ns, evigrid_pose T_map_robot,
                                              const evigrid_reading *readings, size_t count, evigrid_report *report);
/** Lets time pass without a scan, in maps that forget. */
EVIGRID_C_API evigrid_status evigrid_map_advance_to(evigrid_map *map, int64_t stamp_ns);
/** Beyond memory_cap_bytes the tiles that changed longest ago go to a file without a name in that directory, instead
 *  of EVIGRID_LIMIT; no bit of the map changes. EVIGRID_FILE when it cannot be made, and from the calls that need room
 *  when it cannot be written. */
EVIGRID_C_API evigrid_status evigrid_map_page_to(evigrid_map *map, const char *directory);
/** Bytes of tiles in that file; evigrid_map_memory has the others. */
EVIGRID_C_API evigrid_status evigrid_map_paged(const evigrid_map *map, size_t *bytes);
EVIGRID_C_API evigrid_status evigrid_map_clear(evigrid_map *map);
EVIGRID_C_API evigrid_status evigrid_map_clear_rect(evigrid_map *map, evigrid_rect rect);
/** Rolling window; an empty rectangle: none. */
EVIGRID_C_API evigrid_status evigrid_map_set_window(evigrid_map *map, evigrid_rect window);
/** No reading changes these cells any more, until unprotect. */
EVIGRID_C_API evigrid_status evigrid_map_protect(evigrid_map *map, evigrid_rect area);
EVIGRID_C_API evigrid_status evigrid_map_unprotect(evigrid_map *map);
/** Says what is known: row r of rect starts at masses[r·stride]; count masses in all. */
EVIGRID_C_API evigrid_status evigrid_map_write(evigrid_map *map, evigrid_rect rect, const evigrid_mass *masses,
                                               size_t count, ptrdiff_t stride);
/** A prior as nav_msgs/OccupancyGrid has it: −1 leaves the cell alone, 0 … 100 is P(occupied) in percent. */
EVIGRID_C_API evigrid_status evigrid_map_write_occupancy(evigrid_map *map, evigrid_rect rect, const int8_t *occupancy,
                                                         size_t count, ptrdiff_t stride, double certainty);

EVIGRID_C_API evigrid_status evigrid_map_hash(const evigrid_map *map, uint64_t *hash);
EVIGRID_C_API evigrid_status evigrid_map_memory(const evigrid_map *map, size_t *bytes, size_t *tiles);
/** Which kernel really runs: "scalar", "avx2", "avx512", "cuda". Lives as long as the map. "" for NULL. */
EVIGRID_C_API const char *evigrid_map_kernel(const evigrid_map *map);

EVIGRID_C_API evigrid_status evigrid_map_save(const evigrid_map *map, const char *path);
/** params: threads, executor, kernel and memory_cap_bytes of it are used, the rest is the file's. May be NULL. */
EVIGRID_C_API evigrid_status evigrid_map_load(const char *path, const evigrid_params *params, evigrid_map **out);

/* ----------------------------------------------------------------------------------------------------- views */

/** The map as it is now, for ever. Reading is done on views; making one costs what changed since the last. */
typedef struct evigrid_view evigrid_view;
EVIGRID_C_API evigrid_status evigrid_map_view(evigrid_map *map, evigrid_view **out);
EVIGRID_C_API evigrid_status evigrid_view_copy(const evigrid_view *view, evigrid_view **out);
EVIGRID_C_API void evigrid_view_destroy(evigrid_view *view);

/** Counts the calls that changed a cell. */
EVIGRID_C_API evigrid_status evigrid_view_version(const evigrid_view *view, uint64_t *version);
EVIGRID_C_API evigrid_status evigrid_view_hash(const evigrid_view *view, uint64_t *hash);
EVIGRID_C_API evigrid_status evigrid_view_cell_m(const evigrid_view *view, double *cell_m);
/** Smallest box around all cells that are not vacuous. */
EVIGRID_C_API evigrid_status evigrid_view_bounds(const evigrid_view *view, evigrid_rect *bounds);
EVIGRID_C_API evigrid_status evigrid_view_cell_at(const evigrid_view *view, double x_m, double y_m, evigrid_cell *cell);
EVIGRID_C_API evigrid_status evigrid_view_mass(const evigrid_view *view, evigrid_cell cell, evigrid_mass *mass);
/** Writes a layer row by row, smallest y first: row r starts at out[r·stride]; count floats in all. */
EVIGRID_C_API evigrid_status evigrid_view_render(const evigrid_view *view, const char *layer, evigrid_rect rect,
                                                 float *out, size_t count, ptrdiff_t stride);
/** nav_msgs/OccupancyGrid: −1, 0 … 100. 0 ≤ free_below < lethal_above ≤ 1; cells with u above max_unknown are −1. */
EVIGRID_C_API evigrid_status evigrid_view_render_occupancy(const evigrid_view *view, double free_below,
                                                           double lethal_above, double max_unknown, evigrid_rect rect,
                                                           int8_t *out, size_t count, ptrdiff_t stride);
/** costmap_2d: 255 no information, 0 free, 254 lethal, 1 … 252 between. */
EVIGRID_C_API evigrid_status evigrid_view_render_cost(const evigrid_view *view, double free_below, double lethal_above,
                                                      double max_unknown, evigrid_rect rect, uint8_t *out,
                                                      size_t count, ptrdiff_t stride);
/** What changed after a version: up to `capacity` boxes, one a tile, into rects; *count is how many there are, and when
 * that is more than capacity the rest was left out: ask again. *cleared: nothing drawn before holds any more. rects may
 * be NULL when capacity is 0. */
EVIGRID_C_API evigrid_status evigrid_view_changes(const evigrid_view *view, uint64_t since, evigrid_rect *rects,
                                                  size_t capacity, size_t *count, int *cleared);
EVIGRID_C_API evigrid_status evigrid_view_save(const evigrid_view *view, const char *path);

/** Takes what `from` says into the map; T_into_from takes its coordinates to those of the map, reliability in (0, 1].
 * cells (may be NULL): how many received something. */
EVIGRID_C_API evigrid_status evigrid_map_merge(evigrid_map *into, const evigrid_view *from, evigrid_pose T_into_from,
                                               double reliability, uint64_t *cells);

/* --------------------------------------------------------------------------------------------------- algebra */

/** Arrays of n masses each; c may be NULL: none. */
typedef struct evigrid_planes {
  float *e, *o, *u, *c;
} evigrid_planes;
/** out = a ⊕ b, cell by cell; out may be a. conflict (may be NULL) receives k of each pair; total_conflicts (may be
 * NULL) how many pairs agreed on nothing. threads: 1 is the calling one, 0 all of the machine. */
EVIGRID_C_API evigrid_status evigrid_combine(const char *rule, evigrid_planes a, evigrid_planes b, evigrid_planes out,
                                             float *conflict, size_t n, int threads, uint64_t *total_conflicts);
/** Masses of one reading at one point of a sensor's cone or on its beam. */
EVIGRID_C_API evigrid_status evigrid_sensor_evaluate(const evigrid_sensor *sensor, double range_m, double distance_m,
                                                     double theta_rad, evigrid_mass *mass);

#ifdef __cplusplus
}
#endif
#endif
