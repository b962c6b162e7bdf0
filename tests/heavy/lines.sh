#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A thousand random lines in every construction and every way of fairing, a thousand that are faired with growing
# tolerances: curvature extrema must not become more; and a thousand that are made light with growing detail: control
# points must not. LINES_TRIED sets another number of each.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
build test_pipeline test_fairing test_construct >build/lines-build.log 2>&1 || { tail -20 build/lines-build.log; exit 1; }
lines=${LINES_TRIED:-1000}
BATTEN_LINES_OF_A_CASE=$((lines / 10)) BATTEN_RANDOM_LINES=$lines \
  ctest --preset release -j "${BATTEN_JOBS:-2}" --timeout 7200 --no-tests=error -R 'RandomLines|LargerTolerance|MoreDetail'
