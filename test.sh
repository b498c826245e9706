#!/usr/bin/env bash
# Installs what is missing, builds Release with tests and benchmarks, and passes all tests.
# Usage: ./test.sh [ctest arguments, e.g. -R combine]
set -euo pipefail
cd "$(dirname "$0")"
source cmake/packages.sh
evigrid_install "${EVIGRID_PACKAGES[@]}" "${EVIGRID_TEST_PACKAGES[@]}"
cuda=()  # compiled where nvcc 12 or later is, for one architecture; it runs where a GPU is
nvcc=$(PATH="$PATH:/usr/local/cuda/bin" nvcc --version 2>/dev/null || true)
if [[ $nvcc =~ release\ (1[2-9]|[2-9][0-9])\. ]]; then
  cuda=(-DEVIGRID_CUDA=ON -DEVIGRID_CUDA_ARCHITECTURES=90)
fi
generator=(-G Ninja)  # of a build folder that is there CMake would refuse another
if [ -f build/CMakeCache.txt ]; then generator=(); fi
cmake -S . -B build "${generator[@]}" -DCMAKE_BUILD_TYPE=Release -DEVIGRID_BUILD_TESTS=ON -DEVIGRID_BUILD_BENCH=ON \
  -DEVIGRID_BUILD_SHARED=ON -DEVIGRID_BUILD_C=ON -DEVIGRID_BUILD_PYTHON=ON \
  -DPython3_EXECUTABLE=/usr/bin/python3 "${cuda[@]}" >/dev/null
cmake --build build
ctest --test-dir build --output-on-failure --parallel "$(nproc)" "$@"
