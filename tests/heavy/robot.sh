#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A robot at the window: ROBOT_EVENTS (20000) random events on an empty, a half computed and a finished drawing.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
build test_ui >build/robot-build.log 2>&1 || { tail -20 build/robot-build.log; exit 1; }
export BATTEN_ROBOT_EVENTS=${ROBOT_EVENTS:-20000} BATTEN_ROBOT_SEED=${ROBOT_SEED:-1}
xvfb-run -a -s "-screen 0 1600x1000x24" bash -c '
  openbox >/dev/null 2>&1 & manager=$!
  timeout 3000 build/release/bin/test_ui --gtest_filter="RobotAtTheWindow.*"; status=$?
  kill $manager 2>/dev/null
  exit $status'
