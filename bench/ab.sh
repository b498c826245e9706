#!/usr/bin/env bash
# Two commits against each other: both built Release in worktrees of a temporary folder, run in turns A B A B …, the
# ratio of their times for every benchmark as median, minimum and maximum over the pairs (above 1: B is faster).
# Usage: bench/ab.sh REV_A REV_B [benchmark filter] [binary …]
#   bench/ab.sh main HEAD 'pcr5' bench_dense bench_fuse
# Environment: ROUNDS (default 5), MIN_TIME (0.1 s a row), EVIGRID_BENCH_PREFIX as in bench.sh, PYTHON.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,/^set/{/^set/!s/^# \{0,1\}//p}' "$0"; exit 2; }
cd "$(dirname "$0")/.."
rev_a="$1" rev_b="$2" filter="${3:-.}"
shift $(($# < 3 ? $# : 3))
binaries=("$@")
[ ${#binaries[@]} -gt 0 ] || binaries=(bench_dense bench_fuse bench_laser)
python="${PYTHON:-python3}"
data="${EVIGRID_DATA_DIR:-$PWD/../shared/data}"
work="$(mktemp -d)"
cleanup() {
  for side in a b; do git worktree remove --force "$work/$side" 2>/dev/null || true; done
  rm -rf "$work"
}
trap cleanup EXIT
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
for side in a b; do
  rev="$rev_a"
  [ "$side" = b ] && rev="$rev_b"
  git worktree add --quiet --detach "$work/$side" "$rev"
  cmake -S "$work/$side" -B "$work/$side/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DEVIGRID_BUILD_TESTS=OFF \
    -DEVIGRID_BUILD_BENCH=ON -DEVIGRID_DATA_DIR="$data" "${launcher[@]}" >/dev/null
  cmake --build "$work/$side/build" --target "${binaries[@]}" | tail -1
done
files=()
for round in $(seq "${ROUNDS:-5}"); do
  for binary in "${binaries[@]}"; do
    for side in a b; do
      out="$work/$side-$round-$binary.json"
      ${EVIGRID_BENCH_PREFIX:-} "$(find "$work/$side/build/bench" -name "$binary" -type f | head -1)" \
        --benchmark_filter="$filter" --benchmark_min_time="${MIN_TIME:-0.1}" --benchmark_out="$out" \
        --benchmark_out_format=json >"$work/log" 2>&1 || { tail -5 "$work/log"; exit 1; }
      files+=("$out")
    done
  done
done
echo "A = $(git describe --always "$rev_a"), B = $(git describe --always "$rev_b"), ${ROUNDS:-5} pairs"
"$python" bench/tools/ab.py "${files[@]}"
