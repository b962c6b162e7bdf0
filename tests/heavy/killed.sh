#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# KILLS (100) programs are killed by SIGKILL while something is dragged; their work must be offered back.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
build test_ui >build/killed-build.log 2>&1 || { tail -20 build/killed-build.log; exit 1; }
export BATTEN_KILLS=${KILLS:-100} QT_QPA_PLATFORM=offscreen
timeout 3000 build/release/bin/test_ui --gtest_filter='Killed.*'
