#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# A first map: a robot with 24 sonars drives through a room that we make up, and the map is drawn while it grows.
# Run it as a script (`first_map.py OUT.png`) or cell by cell in an editor that knows `# %%`.

# %% The room, and a ring of sonars as Hughes & Murphy had it.
import math
import sys

import numpy as np

import evigrid

room = evigrid.Scene(
    walls=[((-4, -3), (4, -3)), ((4, -3), (4, 3)), ((4, 3), (-4, 3)), ((-4, 3), (-4, -3)), ((0, -3), (0, -0.8))],
    boxes=[(2.5, -1.8, 1.2, 0.6, 0.3)], circles=[(-2, 1, 0.3)], critical_incidence_rad=math.radians(50))

SONARS, APERTURE, FAR = 24, math.radians(15), 5.0
grid = evigrid.Map(cell_m=0.05, rule="pcr5", keep_con=True)
ring = [grid.add(evigrid.Sensor("li2014", T_robot_sensor=(0, 0, 2 * math.pi * i / SONARS), aperture_rad=APERTURE,
                                max_range_m=FAR)) for i in range(SONARS)]

# %% The drive: ten readings a second for half a minute, on an ellipse around the inner wall's end.
used = refused = 0
for step in range(300):
    t = 2 * math.pi * step / 300
    pose = (2.6 * math.cos(t), 1.6 * math.sin(t) + 0.4, t + math.pi / 2)
    headings = pose[2] + 2 * math.pi * np.arange(SONARS) / SONARS
    cones = np.column_stack([np.full(SONARS, pose[0]), np.full(SONARS, pose[1]), headings, np.full(SONARS, APERTURE),
                             np.full(SONARS, 0.1), np.full(SONARS, FAR)])
    ranges = room.cast(cones)
    report = grid.integrate(int(step * 1e8), pose, zip(ring, ranges))
    used, refused = used + report.readings_used, refused + sum(report.refused.values())
print(f"{used} readings used, {refused} heard nothing; kernel {grid.kernel}")

# %% Look: probability of occupied, what is not known, and where readings disagreed.
view = grid.view()
x, y, width, height = view.bounds()
extent = [c * view.cell_m for c in (x, x + width, y, y + height)]
layers = {"betp": "BetP(occupied)", "unknown": "m(unknown)", "con": "weight of conflict, nats"}
pictures = {name: view.render(name) for name in layers}

# %% Draw.
try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("matplotlib is not installed: no picture")
figure, axes = plt.subplots(1, 3, figsize=(15, 4), constrained_layout=True)
for axis, (name, title) in zip(axes, layers.items()):
    image = axis.imshow(pictures[name], origin="lower", extent=extent, cmap="gray_r" if name == "betp" else "viridis")
    axis.set(title=title, xlabel="x, m", ylabel="y, m")
    figure.colorbar(image, ax=axis)
out = sys.argv[1] if len(sys.argv) > 1 else "first_map.png"
figure.savefig(out, dpi=90)
print("look at", out)
