#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The sample's curves are copied in the window and pasted into Inkscape: their size there is their size.
set -euo pipefail
cd "$(dirname "$0")/../.."
. packaging/packages.sh
build batten batten-cli sample_sketch >build/clipboard-build.log 2>&1 || { tail -20 build/clipboard-build.log; exit 1; }
(install_missing inkscape xdotool xclip) || { echo "Inkscape, xdotool or xclip cannot be installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export folder HOME=$folder
echo '<svg xmlns="http://www.w3.org/2000/svg" width="400mm" height="300mm" viewBox="0 0 400 300"/>' >"$folder/page.svg"
cp build/release/share/batten/samples/coupe-side.* "$folder"
build/release/bin/batten-cli trace "$folder/coupe-side.png" --recipe "$folder/coupe-side.recipe.json" -o "$folder/true.svg" >/dev/null

xvfb-run -a -s "-screen 0 1600x1000x24" bash -c '
  # within SECONDS COMMAND...: repeats it until it succeeds; fails where that takes longer.
  within() {
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
      [ $SECONDS -lt $end ] || return 1
      sleep 0.2
    done
  }
  # window NAME: brings the window of that name to the front.
  window() {
    local id
    id=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -1)
    [ -n "$id" ] && xdotool windowactivate "$id" 2>/dev/null && [ "$(xdotool getactivewindow 2>/dev/null)" = "$id" ]
  }
  holds_svg() { timeout 5 xclip -o -selection clipboard -t TARGETS 2>/dev/null | grep -qx image/svg+xml; }
  holds_curve() { grep -q "id=\"curve-1\"" "$folder/page.svg"; }
  # Keys are pressed anew where they have had no effect: nothing tells from outside when a program listens.
  copied() { window coupe-side && xdotool key ctrl+e ctrl+shift+c && within 5 holds_svg; }
  pasted() { window page.svg && xdotool key ctrl+v ctrl+s && within 5 holds_curve; }
  openbox >/dev/null 2>&1 & started=$!
  trap "kill \$started 2>/dev/null" EXIT
  build/release/bin/batten "$folder/coupe-side.png" >/dev/null 2>&1 & started="$started $!"
  within 120 copied || { echo "The window copies no SVG."; exit 1; }
  inkscape "$folder/page.svg" >/dev/null 2>&1 & started="$started $!"
  within 120 pasted || { echo "Inkscape saves no curve."; exit 1; }'

# width NAME: of its curve-1, mm.
width() { inkscape --query-all "$1" 2>/dev/null | awk -F, '$1 == "curve-1" { printf "%.3f\n", $4 / 96 * 25.4 }'; }
pasted=$(width "$folder/page.svg") copied=$(width "$folder/true.svg")
echo "curve-1 is $copied mm wide, pasted into Inkscape $pasted mm"
awk -v a="${pasted:-0}" -v b="$copied" 'BEGIN { exit !(b > 0 && a / b > 0.9999 && a / b < 1.0001) }'
