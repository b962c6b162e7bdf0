#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Exports of test curves of every kind, and of the sample, as other programs read them: one table. Curves are compared at 201
# places where the program reads curves, by their length where it makes chords of them; mm and inch, each by itself. A judge
# that is not installed says so and counts as failed.
# Usage: tests/heavy/exports.sh [FOLDER]   (the files stay there)
set -u
cd "$(dirname "$0")/../.."
. packaging/packages.sh
cli=build/release/bin/batten-cli
scan=build/release/share/batten/samples/coupe-side.png
mkdir -p build
[ -n "${BATTEN_BUILT:-}" ] || build batten-cli sample_sketch >build/exports.log 2>&1 || { tail -5 build/exports.log; exit 1; }
packages=("${judge_packages[@]}")
command -v npm >/dev/null || packages+=(npm)
(install_missing "${packages[@]}") >build/exports.log 2>&1 || echo "Not all judges can be installed: ${packages[*]}"
folder=${1:-}
if [ -z "$folder" ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder"
recipe=${scan%.png}.recipe.json

/usr/bin/python3 tests/judges/exact_curves.py write "$folder/test.json" || exit 1
for unit in mm in; do
  "$cli" trace "$scan" --recipe "$recipe" --unit $unit -o "$folder/cad-$unit.dxf" -o "$folder/cad-$unit.igs" \
    -o "$folder/cad-$unit.step" -o "$folder/cad-$unit.csv" >/dev/null || exit 1
  # The test curves come in as an import and go out as they are.
  "$cli" trace "$folder/test.json" --unit $unit --splines-only -o "$folder/test-$unit.dxf" -o "$folder/test-$unit.igs" \
    -o "$folder/test-$unit.step" -o "$folder/test.svg" >/dev/null || exit 1
done
"$cli" trace "$scan" --recipe "$recipe" --preset laser -o "$folder/laser.dxf" -o "$folder/drawing.svg" -o "$folder/drawing.pdf" \
  >/dev/null || exit 1
"$cli" trace "$scan" --recipe "$recipe" --preset cnc -o "$folder/cnc.dxf" >/dev/null || exit 1

failed=0
# judge NAME COMMAND...: the command prints rows of the table and fails if one is wrong.
judge() {
  local name=$1
  shift
  "$@" 2>"$folder/judge.log" || { failed=1; echo "$name: FAILED: $(tail -1 "$folder/judge.log")"; }
}
need() { command -v "$1" >/dev/null || { echo "$1 is not installed ($2)" >&2; return 1; }; }
judged() { /usr/bin/python3 tests/heavy/judged.py "$1" "$folder"; }

gdal() {
  need ogr2ogr gdal-bin || return 1
  local file
  for file in cad-mm cad-in laser cnc; do
    ogr2ogr -f GeoJSON "$folder/$file.geojson" "$folder/$file.dxf" || return 1
  done
  judged gdal
}
freecad() {
  need freecadcmd freecad || return 1
  rm -f "$folder/freecad.json"
  FOLDER=$folder freecadcmd tests/heavy/freecad_samples.py >"$folder/freecad.log" 2>&1
  judged freecad
}
npm_dxf() {
  need npm npm || return 1
  [ -d "$folder/node_modules/dxf" ] || npm install --silent --prefix "$folder" dxf@5.3.1 >/dev/null || return 1
  NODE_PATH=$folder/node_modules node tests/heavy/npm_lengths.js "$folder" >"$folder/npm.txt" || return 1
  judged npm
}
sizes() {
  need rsvg-convert librsvg2-bin && need pdfinfo poppler-utils || return 1
  rsvg-convert -f pdf -o "$folder/svg.pdf" "$folder/drawing.svg" || return 1
  judged size
}
boxes() { need inkscape inkscape && judged inkscape; }
clean_pdf() {
  need qpdf qpdf || return 1
  qpdf --check "$folder/drawing.pdf" >/dev/null && printf '%-12s %-14s %s\n' qpdf drawing.pdf "no errors"
}

judge ezdxf judged ezdxf
judge FreeCAD freecad
judge GDAL gdal
judge "npm dxf" npm_dxf
judge "rsvg and pdfinfo" sizes
judge Inkscape boxes
judge qpdf clean_pdf
exit $failed
