# SPDX-License-Identifier: Apache-2.0
# Sourced by run.sh, test.sh and bench.sh: what a fresh Debian 12 lacks is installed, or, without root, listed.
EVIGRID_PACKAGES=(
  g++ cmake ninja-build
  libtbb-dev libeigen3-dev libembree-dev libhwy-dev
  libcli11-dev nlohmann-json3-dev libtomlplusplus-dev libfmt-dev libpng-dev zlib1g-dev
  libyaml-cpp-dev libtinyobjloader-dev libzstd-dev
)
EVIGRID_TEST_PACKAGES=(libgtest-dev libbenchmark-dev libgmp-dev pkg-config python3 python3-dev python3-numpy pybind11-dev)
EVIGRID_BENCH_PACKAGES=(libbenchmark-dev python3 python3-matplotlib)
# Formats of other worlds: found where installed, never asked for; the program names what is missing.
EVIGRID_FORMAT_PACKAGES=(liboctomap-dev librosbag-storage-dev libtf2-dev libnav-msgs-dev libsensor-msgs-dev)
EVIGRID_PEER_PACKAGES=(libmrpt-maps-dev liboctomap-dev)  # a gigabyte: only where asked for

evigrid_install() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      as_root=(sudo)
    else
      echo "These Debian packages are missing; install them and run this again:" >&2
      echo "  apt-get install ${missing[*]}" >&2
      return 2
    fi
  fi
  echo "installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
