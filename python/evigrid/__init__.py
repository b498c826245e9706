# SPDX-License-Identifier: Apache-2.0
"""evigrid: evidential occupancy grids from sonar and laser ranges.

    import evigrid

    grid = evigrid.Map(cell_m=0.05, rule="pcr5")
    sonar = grid.add(evigrid.Sensor("li2014", aperture_rad=0.4, max_range_m=5))
    report = grid.integrate(0, (0, 0, 0), {sonar: 2.0})
    picture = grid.view().render("betp")     # float32, row 0 at the smallest y

Metres, radians, nanoseconds. Everything that takes long releases the interpreter's lock.
"""
from ._evigrid import (LAYERS, MAP_RULES, MATHS_VERSION, MODELS, RULES, Map, MapFileError, Report, RevisableMap, Scene,
                       Sensor, Tile, View, __version__, combine, load)

__all__ = ["LAYERS", "MAP_RULES", "MATHS_VERSION", "MODELS", "RULES", "Map", "MapFileError", "Report", "RevisableMap",
           "Scene", "Sensor", "Tile", "View", "__version__", "combine", "load"]
