#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A thousand random lines in every construction and every way of fairing, a thousand that are faired with growing
# tolerances: curvature extrema must not become more; and a thousand that are made light with growing detail: control
# points must not. LINES_TRIED sets another number of each.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
build test_pipeline test_fairing test_construct >build/lines-build.log 2>&1 || { tail -20 build/lines-build.log; exit 1; }
export BATTEN_RANDOM_LINES=${LINES_TRIED:-1000} BATTEN_LINES_OF_A_CASE=$((${LINES_TRIED:-1000} / 10))
# Not by ctest: its limit of time is made for a few lines. Each test is a process of its own, so that all processors work.
for program in test_pipeline:RandomLines test_fairing:LargerTolerance test_construct:MoreDetail; do
  "build/release/bin/${program%%:*}" --gtest_list_tests --gtest_filter="*${program##*:}*" |
    awk -v program="${program%%:*}" '/^[^ ]+\.( |$)/ { suite = $1 } /^  / { print program, suite $1 }'
done | xargs -P "${BATTEN_JOBS:-2}" -L 1 bash -c '
  timeout 7200 "build/release/bin/$0" --gtest_brief=1 --gtest_filter="$1"'
