#!/usr/bin/env bash
# build_and_run.sh static|shared PREFIX PROJECT BUILD CXX: configures, builds and runs the consumer's project.
set -euo pipefail
kind=$1 prefix=$2 project=$3 build=$4 cxx=$5
rm -rf "$build"
static=OFF; [ "$kind" = static ] && static=ON
cmake -S "$project" -B "$build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release \
  -Devigrid_USE_STATIC_LIBS=$static >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
cmake --build "$build" >>"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
"$build/robot"
"$build/c_robot"
# Which kind it really is; and the found package came from the prefix.
needs=$(ldd "$build/robot")  # whole first: a pipe that grep -q closes early fails under pipefail
if [[ $needs == *libevigrid_engine* ]]; then linked=shared; else linked=static; fi
[ "$linked" = "$kind" ] || { echo "asked for $kind, linked $linked"; exit 1; }
