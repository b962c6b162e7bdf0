#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The sample's curves are copied in the window and pasted into Inkscape: their size there is their size.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
build batten batten-cli sample_sketch >build/clipboard-build.log 2>&1 || { tail -20 build/clipboard-build.log; exit 1; }
(install_missing inkscape xdotool) || { echo "Inkscape or xdotool cannot be installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export folder HOME=$folder
echo '<svg xmlns="http://www.w3.org/2000/svg" width="400mm" height="300mm" viewBox="0 0 400 300"/>' >"$folder/page.svg"
cp build/release/share/batten/samples/coupe-side.* "$folder"
build/release/bin/batten-cli trace "$folder/coupe-side.png" --recipe "$folder/coupe-side.recipe.json" -o "$folder/true.svg" >/dev/null

xvfb-run -a -s "-screen 0 1600x1000x24" bash -c '
  # window NAME: waits for a window of that name and brings it to the front.
  window() {
    local id="" i
    for i in $(seq 120); do
      id=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -1)
      [ -n "$id" ] && break
      sleep 0.5
    done
    [ -n "$id" ] || { echo "no window $1"; exit 1; }
    xdotool windowactivate --sync "$id"
    sleep 2
  }
  openbox >/dev/null 2>&1 & started=$!
  build/release/bin/batten "$folder/coupe-side.png" >/dev/null 2>&1 & started="$started $!"
  window coupe-side; sleep 8
  xdotool key ctrl+e; sleep 3
  xdotool key ctrl+shift+c; sleep 3
  inkscape "$folder/page.svg" >/dev/null 2>&1 & started="$started $!"
  window page.svg; sleep 5
  xdotool key ctrl+v; sleep 3
  xdotool key ctrl+s; sleep 3
  kill $started 2>/dev/null
  true' 

# widths NAME: of the whole drawing and of its longest line, mm.
width() { inkscape --query-all "$1" 2>/dev/null | awk -F, '$1 == "curve-1" { printf "%.3f\n", $4 / 96 * 25.4 }'; }
pasted=$(width "$folder/page.svg") copied=$(width "$folder/true.svg")
echo "curve-1 is $copied mm wide, pasted into Inkscape $pasted mm"
awk -v a="${pasted:-0}" -v b="$copied" 'BEGIN { exit !(b > 0 && a / b > 0.9999 && a / b < 1.0001) }'
