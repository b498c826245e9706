#!/usr/bin/env bash
# Installs what is missing, builds Release, and maps the embedded scene: a furnished room, a robot with 24 sonars.
# Usage: ./run.sh [output folder]        pictures and report land there (default: out/room)
set -euo pipefail
cd "$(dirname "$0")"
source cmake/packages.sh
evigrid_install "${EVIGRID_PACKAGES[@]}"
out="${1:-out/room}"
setup=()  # a build folder that is there keeps generator, build type and parts
[ -f build/CMakeCache.txt ] || setup=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DEVIGRID_BUILD_TESTS=OFF
  -DEVIGRID_BUILD_BENCH=OFF -DEVIGRID_BUILD_SHARED=OFF -DEVIGRID_BUILD_C=OFF -DEVIGRID_BUILD_PYTHON=OFF)
cmake -S . -B build "${setup[@]}" >/dev/null
cmake --build build --target evigrid
mkdir -p "$(dirname "$out")"
build/evigrid run -o "$out"
echo "Look at $out/map.png; the figures are in $out/report.json"
