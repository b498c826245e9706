#!/usr/bin/env bash
# Installs what is missing, builds Release, runs every benchmark and writes docs/benchmarks/NAME.json, a table and
# pictures made of it. What each figure means: docs/benchmarks.md.
# Usage: ./bench.sh [--full] [--peers] [--name NAME] [--only REGEX]
#   --full     nine repetitions of every row; else three of a part of them (some minutes)
#   --peers    also install MRPT and OctoMap (a gigabyte); where they are installed, they are compared with anyway
#   --name     of the files; default: the date
#   --only     binaries whose name matches, e.g. 'dense|fuse'
# Environment: EVIGRID_BENCH_PREFIX, a command put before every run, e.g. 'taskset -c 2,3'; PYTHON (with matplotlib).
set -euo pipefail
cd "$(dirname "$0")"
source cmake/packages.sh
mode=short name="$(date -u +%F)" only=. peers=()
while [ $# -gt 0 ]; do
  case "$1" in
    --full) mode=full ;;
    --peers) peers=("${EVIGRID_PEER_PACKAGES[@]}") ;;
    --name) name="$2"; shift ;;
    --only) only="$2"; shift ;;
    -h | --help) sed -n '2,/^set/{/^set/!s/^# \{0,1\}//p}' "$0"; exit 0 ;;
    *) echo "bench.sh: unknown option $1; see ./bench.sh --help" >&2; exit 2 ;;
  esac
  shift
done
evigrid_install "${EVIGRID_PACKAGES[@]}" "${EVIGRID_BENCH_PACKAGES[@]}" "${peers[@]}"
python="${PYTHON:-/usr/bin/python3}"
build=build-bench
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DEVIGRID_BUILD_TESTS=OFF -DEVIGRID_BUILD_BENCH=ON \
  -DEVIGRID_BUILD_SHARED=OFF -DEVIGRID_BUILD_C=OFF -DEVIGRID_BUILD_PYTHON=OFF "${launcher[@]}" >/dev/null
grep -q '^CMAKE_BUILD_TYPE:[A-Z]*=Release$' "$build/CMakeCache.txt" || { echo "bench.sh: $build is no Release build" >&2; exit 2; }
cmake --build "$build"

repetitions=3 min_time=0.05
[ "$mode" = full ] && repetitions=9 min_time=0.2
# Rows of the short mode; an empty entry leaves a binary out of it.
declare -A short_rows=(
  [bench_plan]='generated'
  [bench_astar]='open|rooms'
  [bench_dense]='(loop_.*|.*/(dempster|pcr5|yager|conjunctive))/cells:(1024|16777216)/'
  [bench_latency]='hot|idle_2ms'
  [bench_sonar_peers]='half15/.*avx512(/iter|$)|half7.5/.*avx512/iter|check'
  [bench_laser_peers]='intel/.*(mrpt|mrpt_widening|octomap)(/thin)?/iter|building.*(mrpt|octomap)(/thin)?/iter'
)
json="$(mktemp -d)"
trap 'rm -rf "$json"' EXIT
inputs=()
for binary in "$build"/bench/bench_* "$build"/bench/peers/bench_*; do
  [ -x "$binary" ] && [ -f "$binary" ] || continue
  what="$(basename "$binary")"
  [[ "$what" =~ $only ]] || continue
  flags=(--benchmark_out="$json/$what.json" --benchmark_out_format=json --benchmark_repetitions="$repetitions"
    --benchmark_min_time="$min_time" --benchmark_enable_random_interleaving=true)
  case "$what" in
    *_peers | bench_ops) flags+=(--benchmark_repetitions=1) ;;  # rounds are within a row: see bench/peers/alternate.hpp
    bench_dense | bench_fuse) flags+=(--machine) ;;              # memory and peak arithmetic in the same process and run
  esac
  [ "$mode" = short ] && [ -n "${short_rows[$what]-}" ] && flags+=(--benchmark_filter="${short_rows[$what]}")
  echo "== $what"
  ${EVIGRID_BENCH_PREFIX:-} "$binary" "${flags[@]}" >"$json/$what.txt" 2>&1 || { tail -5 "$json/$what.txt"; exit 1; }
  inputs+=("$json/$what.json")
done
[ ${#inputs[@]} -gt 0 ] || { echo "bench.sh: no benchmark matches '$only'" >&2; exit 2; }

context=("mode=$mode" "repetitions=$repetitions (peers: rounds within a row)"
  "revision=$(git describe --always --dirty 2>/dev/null || echo unknown)"
  "seeds=sonar peers 99, simulated zeros 7, building 3; others are constants of the sources"
  "cell_bytes=12 (e, o, u in float), 16 with the map's running sum of conflict; moved by a dense combination in place: 36"
  "cold=warm: the cells of a scan were used by the scan before; cold: last used 1000 scans (half a gigabyte of tiles) ago")
data="$(sed -n 's/^EVIGRID_DATA_DIR:PATH=//p' "$build/CMakeCache.txt")"
for log in intel freiburg-079; do
  file="$data/laser/ple-radish-corrected/$log-corrected.log.gz"
  [ -f "$file" ] && context+=("input $(basename "$file")=sha256 $(sha256sum "$file" | cut -c1-64)")
done
mkdir -p docs/benchmarks
"$python" bench/tools/report.py merge "docs/benchmarks/$name.json" "${context[@]}" -- "${inputs[@]}"
"$python" bench/tools/report.py page "docs/benchmarks/$name.json"
sed -n '/^| what/,/^$/p' "docs/benchmarks/$name.md"
echo "Look at docs/benchmarks/$name.md"
