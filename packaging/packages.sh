# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by run, test and check: every Debian 12 package that building, running or testing needs, and how they get installed.

build_packages=(
  build-essential cmake ninja-build ccache git
  qt6-base-dev qt6-base-dev-tools libgl1-mesa-dev libqcustomplot-dev
  libopencv-dev libpng-dev libturbojpeg0-dev libeigen3-dev libcli11-dev nlohmann-json3-dev libexpected-dev libssl-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  libdxflib-dev libocct-data-exchange-dev libpoppler-qt6-dev
)
run_packages=(qt6-qpa-plugins libqt6svg6 fonts-inter)
test_packages=(xvfb xauth openbox python3-ezdxf qpdf poppler-utils)
judge_packages=(freecad gdal-bin librsvg2-bin inkscape)  # of the scripts in tests/heavy; npm, too, where there is none
# What packaging/check needs on top.
check_packages=(clang-tidy python3 valgrind)
fuzz_packages=(clang libclang-rt-dev llvm)  # of its part fuzz: libFuzzer, and names instead of addresses in its traces
batch_packages=(parallel snakemake slurmctld slurmd slurm-client munge)  # the ways over several machines
package_packages=(lintian mmdebstrap binutils desktop-file-utils appstream shared-mime-info libglib2.0-bin man-db zsh xdotool)
flatpak_packages=(flatpak-builder)

# install_missing PACKAGE...: installs what is not there yet, asks nothing, and does nothing when all is there.
install_missing() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  echo "Installing: ${missing[*]}"
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "Needs root or sudo to install: ${missing[*]}" >&2; exit 1; }
    root=(sudo)
  fi
  local log
  log=$(mktemp)
  if ! { "${root[@]}" apt-get update -qq &&
         "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 install -y -qq --no-install-recommends "${missing[@]}"; } \
       >"$log" 2>&1; then
    tail -20 "$log" >&2
    echo "The packages could not be installed; the lines above say why." >&2
    exit 1
  fi
  rm -f "$log"
}

# build TARGET...: configures once and builds the release preset below build/release. The cache trusts the compiler's own
# list of included files and knows the precompiled headers, wherever the sources lie.
build() {
  export CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
  cmake --preset release -DBATTEN_PCH=ON >build/configure.log 2>&1 || { tail -30 build/configure.log >&2; exit 1; }
  cmake --build --preset release --target "$@"
}
