# SPDX-License-Identifier: GPL-3.0-or-later
# What zsh offers after some words, in a terminal of its own: zsh -f try-completion.zsh FOLDER_OF_COMPLETIONS
zmodload zsh/zpty
folder=$1
failed=0

# expect "WORD..." LINE: after LINE and Tab all of WORD... are listed.
expect() {
  local one text= part
  zpty shell "TERM=dumb PS1='> ' zsh -f -i"
  zpty -w shell "fpath=($folder \$fpath); autoload -Uz compinit; compinit -u -D; LISTMAX=0; zstyle ':completion:*' menu no; COLUMNS=300; LINES=200; setopt list_ambiguous; unsetopt zle_bracketed_paste; echo re''ady"
  while zpty -r -m shell part '*ready*' 2>/dev/null; do break; done
  zpty -w -n shell "$2"$'\t\t'
  for _ in {1..30}; do
    sleep 0.1
    while zpty -r -t shell part; do text+=$part; done
  done
  zpty -d shell
  for one in ${=1}; do
    if [[ $text != *$one* ]]; then
      print -r -- "zsh, after \"$2\": $one is not in: ${text//[^[:print:]]/ }"
      failed=1
    fi
  done
}

expect 'trace suggest batch parameters compare' 'batten-cli '
expect '--recipe --report' 'batten-cli trace --re'
expect 'fairing.mode fairing.tolerance' 'batten-cli trace --set fairing.'
expect 'false true' 'batten-cli trace --set paper.folds='
expect 'skip overwrite abort' 'batten-cli batch --existing '
expect 'alias rhino' 'batten-cli trace --preset '
expect 'a4 letter' 'batten-cli trace --paper '
expect 'faired sketched both' 'batten-cli trace --which '
expect 'exact bezier cubic' 'batten-cli trace --flavour '
expect 'mm cm in' 'batten-cli trace --import-unit '
exit $failed
