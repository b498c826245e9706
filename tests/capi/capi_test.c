/* SPDX-License-Identifier: Apache-2.0 */
/* The C interface as a C program meets it: what the header says, and what it says of misuse. */
#include <evigrid.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int failures = 0;
#define CHECK(condition)                                                                                      \
  do {                                                                                                        \
    if (!(condition)) {                                                                                       \
      fprintf(stderr, "%s:%d: %s\n  last error: %s\n", __FILE__, __LINE__, #condition, evigrid_last_error()); \
      ++failures;                                                                                             \
    }                                                                                                         \
  } while (0)
#define OK(call) CHECK((call) == EVIGRID_OK)
/* A call that must fail so, and say why with these words. */
#define REFUSED(status, words, call)                            \
  do {                                                          \
    CHECK((call) == (status));                                  \
    CHECK(strstr(evigrid_last_error(), (words)) != NULL);       \
  } while (0)

enum { kSonars = 8 };

static evigrid_map *ring_map(const char *rule, int threads) {
  evigrid_params *params = NULL;
  evigrid_map *map = NULL;
  OK(evigrid_params_create(&params));
  OK(evigrid_params_set_text(params, "rule", rule));
  OK(evigrid_params_set_text(params, "executor", "serial"));
  OK(evigrid_params_set_number(params, "cell_m", 0.1));
  if (threads > 1) {
    OK(evigrid_params_set_text(params, "executor", "tbb"));
    OK(evigrid_params_set_number(params, "threads", threads));
  }
  OK(evigrid_map_create(params, &map));
  evigrid_params_destroy(params);
  for (int i = 0; i < kSonars; ++i) {
    evigrid_sensor *sonar = NULL;
    uint32_t id = 99;
    OK(evigrid_sensor_create("li2014", &sonar));
    OK(evigrid_sensor_set_number(sonar, "yaw_rad", i * 6.283185307179586 / kSonars));
    OK(evigrid_sensor_set_number(sonar, "aperture_rad", 0.3));
    OK(evigrid_sensor_set_number(sonar, "max_range_m", 4));
    OK(evigrid_sensor_set_number(sonar, "rho_e", 0.6));
    OK(evigrid_map_add_sensor(map, sonar, &id));
    CHECK(id == (uint32_t)i);
    evigrid_sensor_destroy(sonar);
  }
  return map;
}

static evigrid_report drive(evigrid_map *map, int steps) {
  evigrid_report sum, one;
  memset(&sum, 0, sizeof sum);
  for (int k = 0; k < steps; ++k) {
    float ranges[kSonars];
    evigrid_reading readings[kSonars];
    const evigrid_pose at = {0.2 * k, 0.05 * k, 0.1 * k};
    for (int i = 0; i < kSonars; ++i) {
      ranges[i] = 1.0f + 0.1f * (float)((i * 7 + k * 3) % 20);
      readings[i].sensor = (uint32_t)i;
      readings[i].ranges_m = &ranges[i];
      readings[i].count = 1;
    }
    if (k == 1) ranges[2] = NAN;
    OK(evigrid_map_integrate(map, 100000000LL * k, at, readings, kSonars, &one));
    sum.readings_used += one.readings_used;
    sum.cells_updated += one.cells_updated;
    for (int r = 0; r < EVIGRID_REFUSALS; ++r) sum.refused[r] += one.refused[r];
  }
  return sum;
}

static void names_and_errors(void) {
  CHECK(strlen(evigrid_version()) >= 5);
  CHECK(evigrid_maths_version() >= 2);
  size_t n = 0;
  int pcr5 = 0;
  for (const char *name; (name = evigrid_rule_name(n)) != NULL; ++n) pcr5 += strcmp(name, "pcr5") == 0;
  CHECK(n >= 20 && pcr5 == 1);
  CHECK(strcmp(evigrid_model_name(0), "hughes1992") == 0);
  CHECK(evigrid_layer_name(10000) == NULL);
  CHECK(strcmp(evigrid_refusal_name(0), "not_a_number") == 0);
  CHECK(strcmp(evigrid_status_name(EVIGRID_FILE), "file") == 0);

  evigrid_params *params = NULL;
  evigrid_sensor *sensor = NULL;
  evigrid_map *map = NULL;
  OK(evigrid_params_create(&params));
  REFUSED(EVIGRID_INVALID, "cel_m", evigrid_params_set_number(params, "cel_m", 1));
  REFUSED(EVIGRID_INVALID, "pcr9", evigrid_params_set_text(params, "rule", "pcr9"));
  REFUSED(EVIGRID_INVALID, "switch", evigrid_params_set_number(params, "keep_con", 0.5));
  REFUSED(EVIGRID_INVALID, "threads", evigrid_params_set_number(params, "threads", -1));
  OK(evigrid_params_set_number(params, "cell_m", -1));
  REFUSED(EVIGRID_INVALID, "map.cell_m", evigrid_map_create(params, &map));
  CHECK(map == NULL);
  REFUSED(EVIGRID_INVALID, "sonar", evigrid_sensor_create("sonar", &sensor));
  OK(evigrid_sensor_create("beam", &sensor));
  REFUSED(EVIGRID_INVALID, "rho_e", evigrid_sensor_set_number(sensor, "rho_e", 0.6));
  REFUSED(EVIGRID_INVALID, "NULL", evigrid_sensor_set_number(NULL, "beams", 2));
  REFUSED(EVIGRID_INVALID, "NULL", evigrid_map_create(NULL, NULL));
  REFUSED(EVIGRID_FILE, "no/such/map", evigrid_map_load("no/such/map", NULL, &map));
  evigrid_sensor_destroy(sensor);
  evigrid_sensor_destroy(NULL);
  evigrid_params_destroy(params);
  evigrid_map_destroy(NULL);
  evigrid_view_destroy(NULL);
}

static void maps_and_views(void) {
  evigrid_map *one = ring_map("pcr5", 1), *two = ring_map("pcr5", 2);
  uint64_t h1 = 0, h2 = 1;
  const evigrid_report r1 = drive(one, 20), r2 = drive(two, 20);
  CHECK(r1.readings_used == 20 * kSonars - 1 && r1.refused[0] == 1);
  CHECK(r1.cells_updated > 10000 && r1.cells_updated == r2.cells_updated);
  OK(evigrid_map_hash(one, &h1));
  OK(evigrid_map_hash(two, &h2));
  CHECK(h1 == h2);
  CHECK(strlen(evigrid_map_kernel(one)) > 0);

  evigrid_view *view = NULL, *copy = NULL;
  evigrid_rect box;
  evigrid_mass mass;
  evigrid_cell cell;
  uint64_t version = 0;
  double cell_m = 0;
  OK(evigrid_map_view(one, &view));
  OK(evigrid_view_copy(view, &copy));
  OK(evigrid_view_version(view, &version));
  CHECK(version == 20);
  OK(evigrid_view_cell_m(view, &cell_m));
  CHECK(cell_m == 0.1);
  OK(evigrid_view_bounds(view, &box));
  CHECK(box.width > 40 && box.height > 40);
  float *betp = malloc(sizeof(float) * (size_t)(box.width * box.height));
  OK(evigrid_view_render(view, "betp", box, betp, (size_t)(box.width * box.height), box.width));
  for (int64_t y = 0; y < box.height; ++y) {
    for (int64_t x = 0; x < box.width; ++x) {
      const evigrid_cell at = {box.x + x, box.y + y};
      OK(evigrid_view_mass(view, at, &mass));
      CHECK(betp[y * box.width + x] == mass.o + mass.u * 0.5f);
    }
  }
  OK(evigrid_view_cell_at(view, 0.05, -0.05, &cell));
  CHECK(cell.x == 0 && cell.y == -1);
  REFUSED(EVIGRID_INVALID, "buffer", evigrid_view_render(view, "betp", box, betp, 10, box.width));
  REFUSED(EVIGRID_INVALID, "betq", evigrid_view_render(view, "betq", box, betp, 10, box.width));
  free(betp);

  /* The view stays as it was; the copy outlives view and map. */
  int8_t grid[16];
  uint8_t cost[16];
  size_t changed = 0;
  int cleared = 0;
  const evigrid_rect small = {0, 0, 4, 4};
  OK(evigrid_map_clear(one));
  OK(evigrid_view_hash(view, &h2));
  CHECK(h1 == h2);
  OK(evigrid_view_render_occupancy(view, 0.2, 0.65, 0.9, small, grid, 16, 4));
  OK(evigrid_view_render_cost(view, 0.2, 0.65, 0.9, small, cost, 16, 4));
  for (int i = 0; i < 16; ++i) CHECK(grid[i] >= -1 && grid[i] <= 100 && (grid[i] == -1) == (cost[i] == 255));
  evigrid_view_destroy(view);
  OK(evigrid_map_view(one, &view));
  OK(evigrid_view_changes(view, version, NULL, 0, &changed, &cleared));
  CHECK(cleared == 1);
  evigrid_view_destroy(view);
  evigrid_map_destroy(one);
  OK(evigrid_view_hash(copy, &h2));
  CHECK(h1 == h2);

  /* Files: the map of the view comes back to the bit. */
  char path[] = "/tmp/evigrid-capi-XXXXXX";
  const int file = mkstemp(path);
  CHECK(file >= 0);
  close(file);
  OK(evigrid_view_save(copy, path));
  evigrid_view_destroy(copy);
  evigrid_map *back = NULL;
  OK(evigrid_map_load(path, NULL, &back));
  OK(evigrid_map_hash(back, &h2));
  CHECK(h1 == h2);
  unlink(path);

  /* A known area, protected; and a merge. */
  evigrid_mass wall[4] = {{0, 0.9f, 0.1f, 0}, {0, 0.9f, 0.1f, 0}, {0, 0.9f, 0.1f, 0}, {0, 0.9f, 0.1f, 0}};
  const evigrid_rect area = {5, 5, 2, 2};
  OK(evigrid_map_write(back, area, wall, 4, 2));
  OK(evigrid_map_protect(back, area));
  drive(back, 20);
  OK(evigrid_map_view(back, &view));
  cell.x = cell.y = 5;
  OK(evigrid_view_mass(view, cell, &mass));
  CHECK(mass.o == 0.9f);
  wall[3].o = 7;
  REFUSED(EVIGRID_INVALID, "", evigrid_map_write(back, area, wall, 4, 2));
  const evigrid_pose apart = {100, 0, 0};
  uint64_t cells = 0;
  size_t bytes = 0, tiles = 0, before = 0;
  OK(evigrid_map_memory(two, NULL, &before));
  OK(evigrid_map_merge(two, view, apart, 0.9, &cells));
  OK(evigrid_map_memory(two, &bytes, &tiles));
  CHECK(cells > 1000 && tiles > before && bytes > 0);
  REFUSED(EVIGRID_INVALID, "reliability", evigrid_map_merge(two, view, apart, 2, &cells));
  size_t paged = 1;
  REFUSED(EVIGRID_FILE, "/no/such/folder", evigrid_map_page_to(two, "/no/such/folder"));
  REFUSED(EVIGRID_INVALID, "directory", evigrid_map_page_to(two, NULL));
  OK(evigrid_map_page_to(two, "/tmp"));
  OK(evigrid_map_paged(two, &paged));
  CHECK(paged == 0);
  evigrid_view_destroy(view);
  evigrid_map_destroy(back);
  evigrid_map_destroy(two);
}

static void limits_and_undo(void) {
  evigrid_map *sums = ring_map("dempster_log", 1), *pcr = ring_map("pcr5", 1);
  const float range = 2;
  const evigrid_reading one = {0, &range, 1};
  const evigrid_pose at = {0, 0, 0};
  uint64_t before = 0, after = 1;
  drive(sums, 3);
  OK(evigrid_map_hash(sums, &before));
  OK(evigrid_map_integrate(sums, 900000000, at, &one, 1, NULL));
  OK(evigrid_map_undo(sums, 900000000, at, &one, 1, NULL));
  OK(evigrid_map_hash(sums, &after));
  CHECK(before == after);
  REFUSED(EVIGRID_UNSUPPORTED, "pcr5", evigrid_map_undo(pcr, 0, at, &one, 1, NULL));
  REFUSED(EVIGRID_INVALID, "NULL", evigrid_map_integrate(pcr, 0, at, NULL, 1, NULL));
  evigrid_map_destroy(sums);
  evigrid_map_destroy(pcr);

  evigrid_params *params = NULL;
  evigrid_map *tiny = NULL;
  evigrid_sensor *laser = NULL;
  OK(evigrid_params_create(&params));
  OK(evigrid_params_set_number(params, "memory_cap_bytes", 100000));
  OK(evigrid_map_create(params, &tiny));
  OK(evigrid_sensor_create("beam", &laser));
  OK(evigrid_sensor_set_number(laser, "beams", 4));
  OK(evigrid_sensor_set_number(laser, "beam_step_rad", 0.1));
  OK(evigrid_sensor_set_number(laser, "max_range_m", 30));
  OK(evigrid_map_add_sensor(tiny, laser, NULL));
  const float ranges[4] = {20, 20, 20, 20};
  const evigrid_reading fan = {0, ranges, 4};
  REFUSED(EVIGRID_LIMIT, "", evigrid_map_integrate(tiny, 0, at, &fan, 1, NULL));
  evigrid_sensor_destroy(laser);
  evigrid_map_destroy(tiny);
  evigrid_params_destroy(params);
}

static void algebra(void) {
  float e[2] = {0.5f, 1}, o[2] = {0.2f, 0}, u[2] = {0.3f, 0}, e2[2] = {0.1f, 0}, o2[2] = {0.6f, 1}, u2[2] = {0.3f, 0};
  float k[2];
  uint64_t total = 9;
  const evigrid_planes a = {e, o, u, NULL}, b = {e2, o2, u2, NULL}, none = {NULL, NULL, NULL, NULL};
  OK(evigrid_combine("dempster", a, b, a, k, 2, 1, &total));
  CHECK(total == 1 && u[1] == 1); /* total conflict: Dempster answers the vacuous mass */
  CHECK(fabsf(k[0] - 0.32f) < 1e-6f && k[1] == 1);
  CHECK(fabsf(e[0] - (0.05f + 0.15f + 0.03f) / 0.68f) < 1e-6f); /* by hand */
  REFUSED(EVIGRID_INVALID, "b needs", evigrid_combine("dempster", a, none, a, NULL, 2, 1, NULL));
  REFUSED(EVIGRID_INVALID, "pcr9", evigrid_combine("pcr9", a, b, a, NULL, 2, 1, NULL));

  evigrid_sensor *sonar = NULL;
  evigrid_mass mass;
  OK(evigrid_sensor_create("hughes1992", &sonar));
  OK(evigrid_sensor_evaluate(sonar, 2, 1, 0, &mass));
  CHECK(mass.e > 0 && mass.o == 0 && fabsf(mass.e + mass.u - 1) < 1e-6f);
  evigrid_sensor_destroy(sonar);
}

int main(void) {
  names_and_errors();
  maps_and_views();
  limits_and_undo();
  algebra();
  if (failures > 0) fprintf(stderr, "%d checks failed\n", failures);
  return failures > 0;
}
