# SPDX-License-Identifier: Apache-2.0
#
# zsh_offers.zsh FOLDER LINE WORD: does an interactive zsh with FOLDER's completions offer WORD after LINE and Tab?
# Waits until it does; the caller bounds that.
zmodload zsh/zpty
zpty shell "TERM=dumb zsh -f -i"
zpty -w shell "fpath=($1 \$fpath); autoload -U compinit; compinit -u -D; LISTMAX=1000; PS1='> '; print set''up"
zpty -r -m shell text '*setup*' || exit 2
zpty -w -n shell "$2"$'\t\t'
zpty -r -m shell text "*$3*" || exit 1
