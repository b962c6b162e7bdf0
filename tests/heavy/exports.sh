#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Exports of the sample as other programs read them: how many curves and how long they are together, in mm, against the CSV of
# the same run. One line a judge; a judge that is not installed says so and counts as failed.
# Usage: tests/heavy/exports.sh [FOLDER]   (the files stay there, for trying them in a CAD)
set -u
cd "$(dirname "$0")/../.."
. packaging/packages.sh
cli=build/release/bin/batten-cli
scan=build/release/share/batten/samples/coupe-side.png
mkdir -p build
build batten-cli sample_sketch >build/exports.log 2>&1 || { tail -5 build/exports.log; exit 1; }
(install_missing "${judge_packages[@]}") >build/exports.log 2>&1 ||
  { echo "exports: cannot install ${judge_packages[*]}"; exit 77; }
folder=${1:-}
if [ -z "$folder" ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder"
recipe=${scan%.png}.recipe.json

for unit in mm in; do
  "$cli" trace "$scan" --recipe "$recipe" --unit $unit -o "$folder/cad-$unit.dxf" -o "$folder/cad-$unit.igs" \
    -o "$folder/cad-$unit.step" -o "$folder/cad-$unit.csv" >/dev/null || exit 1
done
"$cli" trace "$scan" --recipe "$recipe" --preset laser -o "$folder/laser.dxf" -o "$folder/drawing.svg" -o "$folder/drawing.pdf" \
  >/dev/null || exit 1
"$cli" trace "$scan" --recipe "$recipe" --preset cnc -o "$folder/cnc.dxf" >/dev/null || exit 1

failed=0
# judge NAME COMMAND...: the command prints one line and fails if what it saw is wrong.
judge() {
  local name=$1 line
  shift
  if line=$("$@" 2>"$folder/judge.log"); then echo "exports, $name: $line"; else
    failed=1
    echo "exports, $name: FAILED: ${line:-$(tail -1 "$folder/judge.log")}"
  fi
}
need() { command -v "$1" >/dev/null || { echo "$1 is not installed ($2)"; return 1; }; }

gdal() {
  need ogr2ogr gdal-bin || return 1
  local file
  for file in cad-mm cad-in laser cnc; do
    ogr2ogr -f GeoJSON "$folder/$file.geojson" "$folder/$file.dxf" || return 1
  done
  /usr/bin/python3 tests/heavy/lengths.py geojson "$folder"
}
freecad() {
  need freecadcmd freecad || return 1
  FOLDER=$folder freecadcmd tests/heavy/freecad_lengths.py >"$folder/freecad.log" 2>&1
  /usr/bin/python3 tests/heavy/lengths.py freecad "$folder"
}
npm_dxf() {
  need npm npm || return 1
  [ -d "$folder/node_modules/dxf" ] || npm install --silent --prefix "$folder" dxf@5.3.1 >/dev/null || return 1
  NODE_PATH=$folder/node_modules node tests/heavy/npm_lengths.js "$folder" >"$folder/npm.txt" || return 1
  /usr/bin/python3 tests/heavy/lengths.py npm "$folder"
}
svg_size() {
  need rsvg-convert librsvg2-bin && need pdfinfo poppler-utils || return 1
  rsvg-convert -f pdf -o "$folder/svg.pdf" "$folder/drawing.svg" || return 1
  local a b
  a=$(pdfinfo "$folder/svg.pdf" | sed -n 's/^Page size: *//p')
  b=$(pdfinfo "$folder/drawing.pdf" | sed -n 's/^Page size: *//p')
  echo "page of the SVG $a, of the PDF $b"
  /usr/bin/python3 - "$a" "$b" <<'P'
import sys
a, b = ([float(w) for w in text.replace("x", " ").split()[:2]] for text in sys.argv[1:])
sys.exit(any(abs(p - q) > 0.02 for p, q in zip(a, b)))
P
}

judge GDAL gdal
judge FreeCAD freecad
judge "npm dxf" npm_dxf
judge "rsvg and pdfinfo" svg_size
exit $failed
