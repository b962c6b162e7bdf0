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

# expect_line NAME WORDS...: NAME, which has blanks, is offered as one.
expect_line() {
  local wanted=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _batten_cli
  if ! printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$wanted"; then
    echo "bash, after \"$*\": $wanted is not among \"${COMPREPLY[*]}\""
    failed=1
  fi
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
expect 'alias rhino' batten-cli trace --preset ''
expect 'a4 letter' batten-cli trace --paper ''
expect 'mm in' batten-cli trace --unit ''
expect 'faired sketched both' batten-cli trace --which ''
expect 'exact bezier cubic' batten-cli trace --flavour ''
expect 'mm cm m in' batten-cli trace --import-unit ''
folder=$(mktemp -d)
cd "$folder" || exit 1
: >'front view 1.png'
expect_line 'front view 1.png' batten-cli trace fro
expect_line 'front view 1.png' batten-cli trace --recipe front
rm -rf "$folder"
exit $failed
