#!/usr/bin/env bash
# Presses TAB in bash, zsh and fish with the completion of an installed lamella, and reads its manual pages for faults.
# Usage: tests/completion.sh PREFIX
set -euo pipefail
cd "$(dirname "$0")/.."
prefix=$(realpath "$1")
bash_script=$prefix/share/bash-completion/completions/lamella
zsh_folder=$prefix/share/zsh/site-functions
fish_script=$prefix/share/fish/vendor_completions.d/lamella.fish
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_CONFIG_HOME=$scratch/config
mkdir -p "$XDG_CONFIG_HOME/lamella/printers" "$scratch/files/folder"
touch "$XDG_CONFIG_HOME/lamella/printers/my-own.toml"
touch "$scratch/files"/{part.toml,PART2.STL,notes.txt,ready.gcode,'two words.toml'}
fail() { echo "completion: $*" >&2; exit 1; }

bash -n "$bash_script"
zsh -n "$zsh_folder/_lamella"
cd "$scratch/files"

# What bash offers when TAB is pressed behind these words, of which the last may be empty.
offered() {
    bash --norc -uc '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lamella
        printf "%s\n" ${COMPREPLY[@]+"${COMPREPLY[@]}"}' bash "$bash_script" lamella "$@"
}
# expect "what is offered, sorted" WORDS...
expect() {
    local want=$1 found
    shift
    found=$(offered "$@" | LC_ALL=C sort | paste -sd' ')
    [ "$found" = "$want" ] || fail "bash: lamella $*: offers '$found' instead of '$want'"
}
# The same for some of many.
expect_among() {
    local want=$1 found
    shift
    found=$(offered "$@")
    grep -qxF -e "$want" <<<"$found" || fail "bash: lamella $*: does not offer $want"
}
expect "section send serve slice studio supports" s
expect "--help --help-all" --h
expect "--skin-threshold" slice part.toml --skin-thr
expect "gyroid" slice --foam g
expect "gyroid" slice --foam = g
expect_among voronoi slice --foam ""
expect "bridges" supports --support b
expect "prusa-mk4" slice part.toml --printer prusa-m
expect "my-own" slice part.toml --printer my
expect "prusa-sl1 prusa-sl1s" slice part.toml -o out.sl1 @ prusa-sl
expect "PART2.STL folder part.toml two words.toml" slice ""
expect "PART2.STL folder part.toml two words.toml" check --layer-height 0.2 ""
expect "part.toml" slice p
expect "ready.gcode" print r
expect "folder" extract job.sl1 -o fold
expect "beams elements seeds" dump ""
expect "part.toml" dump seeds p
expect "csv" dump seeds part.toml --format c
expect "svg" section part.toml --format s
expect "--layers" slice --layers 0 : 40 part.toml --layers
expect "ready.gcode" join part.toml --shards a b r
expect "--quiet" join part.toml --shards a b --quie
expect "--json" slice part.toml --json
expect "" slice --cell ""
expect "foam" keys fo
expect "slice" man sl
expect "bash fish zsh" completion ""
expect "pla pla-matte" slice --material pla
[ "$(offered slice part.toml "" | grep -c -- '^--')" -gt 250 ] || fail "bash: slice has no options"

# zsh says what it offers only on a terminal: a second zsh plays one.
cat >"$scratch/press.zsh" <<'ZSH'
zmodload zsh/zpty
zpty -b shell "TERM=dumb zsh -f -i"
# Reads the screen until it shows all of the words, or nothing has come for ten seconds.
screen_with() {
    local part got= quiet=0 want missing=1
    for ((; missing && quiet < 200;)); do
        if zpty -r -t shell part; then got+=$part quiet=0; else sleep 0.05; ((quiet += 1)); fi
        missing=0
        for want; do [[ $got == *"$want"* ]] || missing=1; done
    done
    print -r -- "$got"
}
zpty -w shell "PS1='> ' LISTMAX=10000; fpath=($ZSH_FOLDER \$fpath); autoload -Uz compinit; compinit -u -D; print re''ady"
screen_with ready >/dev/null
zpty -w -n shell "$1"$'\t\t'
shift
screen_with "$@"
zpty -d shell
ZSH
press() {
    local found
    found=$(ZSH_FOLDER=$zsh_folder zsh -f "$scratch/press.zsh" "$@")
    shift
    for want; do
        [[ $found == *"$want"* ]] || fail "zsh: does not offer $want; its screen: $found"
    done
}
press "lamella sup" "lamella supports"
press "lamella " "homogenize" "List back-ends and machine profiles"
press "lamella slice --skin-thr" "--skin-threshold"
press "lamella slice --foam vor" "voronoi"
press "lamella slice --foam=schwarz-" "schwarz-p" "schwarz-d"
press "lamella slice " "PART2.STL" "part.toml"
press "lamella slice --printer my" "my-own"
press "lamella slice part.toml -o out.sl1@prusa-m" "@prusa-mk4"
press "lamella dump " "seeds" "beams"
press "lamella join part.toml --shards a b read" "ready.gcode"
press "lamella print --dry" "--dry-run"

# fish says what it would offer.
fish --no-execute "$fish_script"
press_fish() {
    local line=$1 found
    shift
    found=$(fish --no-config -c 'source $argv[1]; complete -C $argv[2]' "$fish_script" "$line")
    for want; do
        cut -f 1 <<<"$found" | grep -qxF -e "$want" || fail "fish: $line: does not offer $want but $found"
    done
}
press_fish "lamella sup" supports
press_fish "lamella " slice homogenize
press_fish "lamella slice --skin-thr" --skin-threshold
press_fish "lamella slice --foam vor" voronoi
press_fish "lamella slice " part.toml PART2.STL folder/
press_fish "lamella slice --printer my" my-own
press_fish "lamella slice part.toml -o out.sl1@prusa-m" out.sl1@prusa-mk4
press_fish "lamella man sl" slice
press_fish "lamella print --dry" --dry-run
press_fish "lamella completion " bash zsh fish

# Pages have no date: the same program makes the same page.
pages=("$prefix"/share/man/man1/lamella*.1)
commands=$("$prefix/bin/lamella" man | sed -n '/^\.SH COMMANDS/,/^\.SH OPTIONS/p' | grep -c '^.TP')
[ ${#pages[@]} -eq $((commands + 1)) ] || fail "$commands commands and the program have ${#pages[@]} pages"
if mandoc -T lint -W warning "${pages[@]}" | grep -v 'missing date, using ""'; then
    fail "mandoc warns of the pages"
fi
page=$(mandoc -T ascii "$prefix/share/man/man1/lamella-slice.1" | col -b)
for words in "--no-drop-islands" "Recipe [foam]" "lamella slice insole.toml -o insole/"; do
    grep -qF -e "$words" <<<"$page" || fail "the page of slice does not show $words"
done
echo "completion: bash, zsh and fish complete, ${#pages[@]} manual pages"
