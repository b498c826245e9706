#!/usr/bin/env bash
# pkg_config.sh PREFIX LIBDIR PROJECT CXX CC: the same sources without CMake. 77 (skipped) where pkg-config is not.
set -euo pipefail
prefix=$1 libdir=$2 project=$3 cxx=$4 cc=$5
command -v pkg-config >/dev/null || { echo "no pkg-config"; exit 77; }
export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig"
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
[ "$(pkg-config --modversion evigrid_engine)" = "$(pkg-config --modversion evigrid)" ]
"$cxx" $(pkg-config --cflags evigrid_engine evigrid_raycast) "$project/robot.cpp" -o "$work/robot" \
  $(pkg-config --libs evigrid_engine evigrid_raycast)
"$cc" $(pkg-config --cflags evigrid) "$project/robot.c" -o "$work/c_robot" $(pkg-config --libs evigrid) -lm
export LD_LIBRARY_PATH="$prefix/$libdir"
"$work/robot"
"$work/c_robot"
# And with the static libraries, as --static names what they need.
rm -rf "$work/static"; mkdir "$work/static"; cp "$prefix/$libdir"/*.a "$work/static"
"$cxx" $(pkg-config --cflags evigrid_engine evigrid_raycast) "$project/robot.cpp" -o "$work/robot_static" -L"$work/static" \
  $(pkg-config --static --libs evigrid_engine evigrid_raycast | sed "s:-L$prefix[^ ]*::g")
LD_LIBRARY_PATH= "$work/robot_static"
