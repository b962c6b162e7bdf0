#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# An archive of 200 pages by each of the four ways: batten-cli batch, GNU parallel, a Slurm job array and Snakemake. Each is
# killed by -9 twice in the middle and started again. Then every page has to be told of once, with the outputs of single
# calls, byte for byte, and the failures of single calls. Prints a table with pages a minute, processor time and memory, and
# for comparison a loop of single calls; whether two jobs are 1.8 times as fast is judged where nothing else runs meanwhile. Also
# prints what the sample sketch costs, the figures of the help page on many drawings.
#
#   tests/heavy/batch.sh              200 pages
#   BATTEN_BATCH_PAGES=40 BATTEN_BATCH_WAYS="slurm snakemake" BATTEN_BATCH_TIMEOUT=60 tests/heavy/batch.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
mkdir -p build/check
install_missing "${build_packages[@]}" python3 "${batch_packages[@]}"
if [ -z "${BATTEN_CLI:-}" ]; then
  build batten-cli sample_sketch >build/check/batch-build.log 2>&1 || { tail -20 build/check/batch-build.log; exit 1; }
  export BATTEN_CLI=$PWD/build/release/bin/batten-cli
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
exec_status=0
python3 tests/heavy/batch.py "$work" "${BATTEN_BATCH_PAGES:-200}" || exec_status=$?
exit "$exec_status"
