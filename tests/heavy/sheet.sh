#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The contact sheet of a batch, opened from the disk in headless Chromium: every small picture loads, every page that is done
# has its curves over its picture, every link leads to a file, the curves can be switched off. A picture of the sheet is left in
# build/check/sheet.png for a person to look at.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
mkdir -p build/check
install_missing "${build_packages[@]}" python3 chromium
if [ -z "${BATTEN_CLI:-}" ]; then
  build batten-cli sample_sketch >build/check/sheet-build.log 2>&1 || { tail -20 build/check/sheet-build.log; exit 1; }
  export BATTEN_CLI=$PWD/build/release/bin/batten-cli
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 tests/heavy/make_pages.py "$work/archive" 20 without-slow
# Names as people give them.
mkdir "$work/archive/scans/front & rear #2"
mv "$work/archive/scans/p0001.pgm" "$work/archive/scans/front & rear #2/50 % <é>.pgm"
rm "$work/archive/pages.jsonl"
sample=build/release/share/batten/samples/coupe-side
[ -e "$sample.png" ] && cp "$sample.png" "$sample.recipe.json" "$work/archive/scans/"
status=0
(cd "$work/archive" && "$BATTEN_CLI" batch scans --to curves --jobs 2 --page-timeout 120 --sheet curves/index.html \
  >results.jsonl) || status=$?
[ "$status" -eq 6 ] || { echo "the batch ended with $status; 6 was expected, as a page is damaged"; exit 1; }
python3 tests/heavy/sheet.py "$work/archive" "$work/profile" build/check/sheet.png
