#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A build without Open CASCADE: core and the command line program compile, the tests of the other formats pass, IGES and STEP are
# refused with a sentence that says what to do, and the IGES and STEP of others are still read (build/without-occt).
set -euo pipefail
cd "$(dirname "$0")/../.."
jobs=${BATTEN_JOBS:-2}
export CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
cmake --preset release -B build/without-occt -DBATTEN_OCCT=OFF -DBATTEN_GUI=OFF -DBATTEN_BENCH=OFF -DBATTEN_PCH=ON
cmake --build build/without-occt -j "$jobs" --target test_exchange batten-cli
# These tests are of IGES and STEP themselves, or write every format there is.
build/without-occt/bin/test_exchange --gtest_brief=1 \
  --gtest_filter='-*IgesAndStep.*:StepFile.*:ExportFile.EveryPreset*:ExportFile.WritesEveryFormat*'
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf 'curve,x_mm,y_mm\nroof,0,0\nroof,30,12\nroof,60,15\nroof,90,10\n' >"$folder/roof.csv"
cli=$PWD/build/without-occt/bin/batten-cli
"$cli" trace "$folder/roof.csv" -o "$folder/roof.dxf" >/dev/null
"$cli" trace "$folder/roof.dxf" -o "$folder/again.svg" >/dev/null
for ending in igs step; do
  status=0
  said=$("$cli" trace "$folder/roof.csv" -o "$folder/roof.$ending" 2>&1) || status=$?
  case $status:$said in
    0:*) echo "$ending was not refused"; exit 1 ;;
    *"without Open CASCADE"*) echo "$ending: $said" ;;
    *) echo "$ending: no reason: $said"; exit 1 ;;
  esac
  [ ! -e "$folder/roof.$ending" ] || { echo "a file was left"; exit 1; }
done
