#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Counts the instructions of a run from grey to curves on a small page, on one thread, and fails where they are more than
# 1 % above those in tests/heavy/instructions.txt: unlike times they do not depend on what else the machine does. A count
# holds for one compiler and for processors with AVX2; elsewhere the part is skipped.
#
#   tests/heavy/instructions.sh --write   takes the counts of now: after a change that is worth its instructions
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
counts=tests/heavy/instructions.txt
command -v valgrind >/dev/null || { echo "valgrind is not installed"; exit 77; }
grep -qw avx2 /proc/cpuinfo 2>/dev/null || { echo "the processor has no AVX2"; exit 77; }
compiler=$(c++ -dumpfullversion)
if [ "${1:-}" != --write ]; then
  [ -e $counts ] || { echo "there is no $counts yet"; exit 77; }
  read -r _ of <$counts
  [ "$of" = "$compiler" ] || { echo "the counts are of compiler $of, here is $compiler"; exit 77; }
fi
build batten-cli >build/instructions-build.log 2>&1 || { tail -20 build/instructions-build.log; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 tests/heavy/line_page.py "$work/page.pgm"

# count NAME OPTION...: instructions from the scan in memory to the curves.
count() {
  local name=$1 number
  shift
  valgrind --tool=callgrind --callgrind-out-file="$work/out" --toggle-collect='batten::runPipeline*' \
    build/release/bin/batten-cli trace "$work/page.pgm" -o "$work/curves.json" --threads 1 "$@" >"$work/log" 2>&1 ||
    { tail -5 "$work/log" >&2; exit 1; }
  number=$(sed -n 's/^.*Collected : \([0-9]*\).*/\1/p' "$work/log")
  [ "${number:-0}" -gt 0 ] || { echo "$name: nothing was counted" >&2; exit 1; }
  echo "$name $number"
}
{
  echo "compiler $compiler"
  count light
  count dense --set construct.light=false
  count outlines --set edges.mode=outline --set construct.method=nurbs
} >"$work/now"
if [ "${1:-}" = --write ]; then
  cp "$work/now" $counts
  cat $counts
  exit 0
fi
awk 'NR == FNR { before[$1] = $2; next } $1 == "compiler" { next }
  { more = 100 * ($2 / before[$1] - 1); printf "%-9s %d, before %d: %+.2f %%\n", $1, $2, before[$1], more
    if (!($1 in before) || more > 1) worse = 1 }
  END { if (worse) print "More than 1 %: cure it, or take the counts of now with tests/heavy/instructions.sh --write."; exit worse }' \
  $counts "$work/now"
