/* SPDX-License-Identifier: Apache-2.0 */
/* The same in C: one sonar looks at a wall. */
#include <evigrid.h>
#include <stdio.h>

static int check(evigrid_status status) {
  if (status != EVIGRID_OK) fprintf(stderr, "%s: %s\n", evigrid_status_name(status), evigrid_last_error());
  return status != EVIGRID_OK;
}

int main(void) {
  evigrid_map *map = NULL;
  evigrid_sensor *sonar = NULL;
  evigrid_view *view = NULL;
  uint32_t id = 0;
  evigrid_report report;
  const evigrid_pose robot = {0, 0, 0};
  const float range = 2;
  float row[60];
  const evigrid_rect ahead = {0, 0, 60, 1};

  if (check(evigrid_map_create(NULL, &map)) || check(evigrid_sensor_create("hughes1992", &sonar)) ||
      check(evigrid_map_add_sensor(map, sonar, &id))) {
    return 1;
  }
  const evigrid_reading reading = {id, &range, 1};
  if (check(evigrid_map_integrate(map, 0, robot, &reading, 1, &report)) || check(evigrid_map_view(map, &view)) ||
      check(evigrid_view_render(view, "bel", ahead, row, 60, 60))) {
    return 1;
  }
  printf("evigrid %s: %llu cells, Bel(occupied) 1 m ahead %.3f, at the wall %.3f\n", evigrid_version(),
         (unsigned long long)report.cells_updated, row[20], row[40]);
  evigrid_view_destroy(view);
  evigrid_sensor_destroy(sonar);
  evigrid_map_destroy(map);
  return row[40] > row[20] ? 0 : 1;
}
