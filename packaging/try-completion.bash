# SPDX-License-Identifier: GPL-3.0-or-later
# What bash offers after some words, held against what it should offer: try-completion.bash COMPLETION_FILE
. "$1"
compopt() { :; }
failed=0

# expect "WORD..." WORDS...: after WORDS (the last is being typed) all of WORD... are offered.
expect() {
  local wanted=$1 one
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _batten_cli
  for one in $wanted; do
    if ! printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$one"; then
      echo "bash, after \"$*\": $one is not among \"${COMPREPLY[*]}\""
      failed=1
    fi
  done
}

expect 'trace suggest batch parameters compare' batten-cli ''
expect 'trace' batten-cli tr
expect '--recipe --report' batten-cli trace scan.png --re
expect 'fairing.mode= fairing.tolerance=' batten-cli trace --set fairing.
expect 'tolerance' batten-cli trace --set fairing.mode = tol
expect 'false true' batten-cli trace --set paper.folds =
expect 'edges= faired=' batten-cli trace --dump ''
expect 'skip overwrite abort' batten-cli batch --existing ''
expect 'overwrite' batten-cli batch --existing o
exit $failed
