#!/usr/bin/env bash
# readme.sh PREFIX LIBDIR README CXX: the first C++ of the README, as a reader copies it. 77 (skipped) where pkg-config is not.
set -euo pipefail
prefix=$1 libdir=$2 readme=$3 cxx=$4
command -v pkg-config >/dev/null || { echo "no pkg-config"; exit 77; }
export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig" LD_LIBRARY_PATH="$prefix/$libdir"
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
awk '/^```cpp$/ {inside = 1; next} /^```$/ && inside {exit} inside' "$readme" >"$work/readme.cpp"
"$cxx" $(pkg-config --cflags evigrid_engine) -Wall -Werror "$work/readme.cpp" -o "$work/readme" $(pkg-config --libs evigrid_engine)
said=$("$work/readme")
[[ $said =~ ^cells\ [1-9][0-9]*,\ refused\ 0,\ empty\ 0\.[0-9]+,\ occupied\ 0\. ]] || { echo "$said"; exit 1; }
