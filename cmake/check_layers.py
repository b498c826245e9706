#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Who may include whom. Reads every #include of the tree and names each one that points the wrong way."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
SOURCE = {".cpp", ".hpp", ".h", ".cu", ".cuh", ".in"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
# Third-party headers, by who may see them.
THIRD = {
    "tbb": re.compile(r"^(tbb|oneapi/tbb)/"), "omp": re.compile(r"^omp\.h$"), "eigen": re.compile(r"^(unsupported/)?Eigen/"),
    "embree": re.compile(r"^embree[34]/"), "highway": re.compile(r"^hwy/"), "toml": re.compile(r"^toml\+\+/"),
    "cli": re.compile(r"^CLI/"), "json": re.compile(r"^nlohmann/"), "png": re.compile(r"^png\.h$"),
    "zlib": re.compile(r"^zlib\.h$"), "fmt": re.compile(r"^fmt/"), "zstd": re.compile(r"^zstd\.h$"),
    "cuda": re.compile(r"^cuda_runtime\.h$"),
    "pybind11": re.compile(r"^pybind11/"),
    "yaml": re.compile(r"^yaml-cpp/"),
    "octomap": re.compile(r"^octomap/"), "ros": re.compile(r"^(ros|roslz4|rosbag|tf2|console_bridge|\w+_msgs)/"),
    "tinyobj": re.compile(r"^tiny_obj_loader\.h$"),
}
# Room: folders it may include from (by include path prefix), third parties it may include.
ROOMS = {
    "kernels": (("kernels/",), {"highway", "cuda"}),
    "engine": (("evigrid/", "kernels/row/", "kernels/device/device.hpp", "device/", "scan/", "grid/", "exec/", "params/", "io/", "integrate.hpp"), {"tbb", "omp", "zstd"}),
    "engine/include": (("evigrid/",), set()),
    "raycast": (("evigrid/raycast/", "@raycast"), {"embree", "tbb", "eigen", "highway"}),
    "raycast/include": (("evigrid/raycast/",), set()),
    "scenes": (("evigrid/scenes/", "evigrid/raycast/", "@scenes"), {"toml", "fmt", "png", "yaml", "tinyobj", "tbb"}),
    "scenes/include": (("evigrid/scenes/", "evigrid/raycast/"), set()),
    "capi": (("evigrid/", "@capi"), set()),
    "capi/include": ((), set()),
    "python": (("evigrid/", "@python"), {"pybind11"}),
    "driver": (("evigrid/", "@driver"), {"cli", "json", "png", "zlib", "fmt", "tbb", "toml", "embree", "eigen", "octomap"}),
    "driver/ros_bag": (("bag.hpp", "check.hpp", "frames.hpp"), {"ros", "eigen"}),
}
OTHERS = {"evigrid/raycast/": "raycast", "evigrid/scenes/": "scenes"}


def room_of(path):
    parts = path.relative_to(ROOT).parts
    inner = "/".join(parts[:2])
    return parts[0], inner if inner in ROOMS else parts[0]


bad, seen = [], 0
for path in sorted(p for p in ROOT.rglob("*") if p.suffix in SOURCE):
    rel = path.relative_to(ROOT)
    if rel.parts[0] not in ROOMS:
        continue
    top, room = room_of(path)
    allowed, third = ROOMS[room]
    for header in INCLUDE.findall(path.read_text(errors="replace")):
        seen += 1
        owner = next((name for name, rx in THIRD.items() if rx.match(header)), None)
        if owner is not None:
            if owner not in third:
                bad.append(f"{rel}: <{header}>: {room} may not see {owner}")
            continue
        if header.startswith("sys/"):
            continue  # POSIX
        if "/" not in header and not (ROOT / top).joinpath("src", header).exists() and not path.parent.joinpath(header).exists():
            continue  # the standard library
        own = any((ROOT / top / sub / header).exists() for sub in ("", "src", "include")) or path.parent.joinpath(header).exists()
        if f"@{top}" in allowed and own:
            continue
        if not any(header.startswith(a) for a in allowed if not a.startswith("@")):
            if own and room == top:
                continue
            bad.append(f"{rel}: \"{header}\": {room} may not include it")
            continue
        if top == "engine" and any(header.startswith(o) for o in OTHERS):
            bad.append(f"{rel}: \"{header}\": the engine knows no {header}")
        if top == "raycast" and header.startswith("evigrid/") and not header.startswith("evigrid/raycast/"):
            bad.append(f"{rel}: \"{header}\": raycast knows no grid")
if seen < 50:
    bad.append(f"only {seen} includes found under {ROOT}: the check itself is broken")
print("\n".join(bad) if bad else f"{seen} includes, none against the layers")
sys.exit(1 if bad else 0)
