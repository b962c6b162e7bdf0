#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Exports of test curves of every kind, of the sample and of the sample as dense curves, as other programs read them: one
# table. Curves are compared at 201 places where the program reads curves, by their length where it makes chords of them; mm
# and inch, each by itself. A judge that is not installed says so and counts as failed.
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
# of_test OPTION... and of_sample OPTION...: the test curves come in as an import and go out as they are.
of_test() { "$cli" trace "$folder/test.json" "$@" >/dev/null || exit 1; }
of_sample() { "$cli" trace "$scan" --recipe "$recipe" "$@" >/dev/null || exit 1; }
of_dense() { of_sample --set construct.light=false "$@"; }
of_sample -o "$folder/sample.json"
of_dense -o "$folder/dense.json"
for which in test sample dense; do
  for unit in mm in; do
    outputs=()
    for ending in dxf igs step 3dm csv poly.csv; do outputs+=(-o "$folder/$which-$unit.$ending"); done
    of_$which --unit $unit --splines-only "${outputs[@]}"
  done
  of_$which -o "$folder/$which.svg" -o "$folder/$which.pdf"
done
for unit in mm in; do
  of_sample --unit $unit -o "$folder/plain-$unit.dxf" -o "$folder/plain-$unit.igs" -o "$folder/plain-$unit.step"
done
for flavour in cubic bezier; do of_sample --flavour $flavour -o "$folder/$flavour.igs" -o "$folder/$flavour.step"; done
of_sample --preset laser -o "$folder/laser.dxf"
of_sample --preset cnc -o "$folder/cnc.dxf"

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
  for file in plain-mm plain-in laser cnc; do
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
package() {
  need npm npm || return 1
  [ -d "$folder/node_modules/$1" ] || npm install --silent --prefix "$folder" "$1@$2" >/dev/null
}
npm_dxf() {
  package dxf 5.3.1 || return 1
  NODE_PATH=$folder/node_modules node tests/heavy/npm_lengths.js "$folder" >"$folder/npm.txt" || return 1
  judged npm
}
rhino3dm() {
  package rhino3dm 8.35.0 || return 1
  NODE_PATH=$folder/node_modules node tests/heavy/rhino_samples.js "$folder"/*.3dm >"$folder/rhino.txt" || return 1
  judged rhino
}
drawn() {
  need rsvg-convert librsvg2-bin && need pdftocairo poppler-utils || return 1
  local which
  for which in test sample dense; do
    rsvg-convert -f pdf -o "$folder/$which-by-rsvg.pdf" "$folder/$which.svg" &&
      pdftocairo -svg -noshrink -nocenter "$folder/$which-by-rsvg.pdf" "$folder/$which-by-rsvg.svg" &&
      pdftocairo -svg -noshrink -nocenter "$folder/$which.pdf" "$folder/$which-by-poppler.svg" || return 1
  done
  judged paths && judged size
}
boxes() { need inkscape inkscape && judged inkscape; }
clean_pdf() {
  need qpdf qpdf || return 1
  qpdf --check "$folder/sample.pdf" >/dev/null && printf '%-12s %-18s %s\n' qpdf sample.pdf "no errors"
}

judge "own parsers" judged parser
judge "own parsers" judged tables
judge ezdxf judged ezdxf
judge FreeCAD freecad
judge GDAL gdal
judge "npm dxf" npm_dxf
judge rhino3dm rhino3dm
judge "rsvg and Poppler" drawn
judge Inkscape boxes
judge qpdf clean_pdf
exit $failed
