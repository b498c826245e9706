#!/usr/bin/env bash
# Installs what is missing, builds Release with tests and benchmarks, and passes all tests.
# Usage: ./test.sh [ctest arguments, e.g. -R combine]
set -euo pipefail
cd "$(dirname "$0")"
source cmake/packages.sh
evigrid_install "${EVIGRID_PACKAGES[@]}" "${EVIGRID_TEST_PACKAGES[@]}"
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DEVIGRID_BUILD_TESTS=ON -DEVIGRID_BUILD_BENCH=ON >/dev/null
cmake --build build
ctest --test-dir build --output-on-failure --parallel "$(nproc)" "$@"
