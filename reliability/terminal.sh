#!/usr/bin/env bash
# No terminal, closed streams, nobody who reads, a terminal that changes its size or goes away: the results are the same.
source "$(dirname "$0")/common.sh"
times=${1:-5}
undisturbed

# Runs the case with a new result directory $out, under what the arguments say.
anew() {
    rm -rf "$out"
    "$@"
}

out=$scratch/run
for i in $(seq "$times"); do
    go=("$program" "${case[@]}" --out "$out")
    closed() { "${go[@]}" <&- >&- 2>&-; }
    nowhere() { "${go[@]}" </dev/null >/dev/null 2>/dev/null; }
    full() { "${go[@]}" >/dev/full 2>/dev/full; }
    unread() { "${go[@]}" 2>&1 | true; return "${PIPESTATUS[0]}"; }
    detached() { setsid --wait "${go[@]}" </dev/null >/dev/null 2>&1; }
    for how in closed nowhere full unread detached; do
        judge "$how" anew $how
        judge "the results, $how" same_as_undisturbed "$out"
    done
    if command -v python3 >/dev/null; then
        judge "a terminal that changes its size" anew python3 reliability/terminal.py resize "${go[@]}"
        judge "the results" same_as_undisturbed "$out"
        judge "a terminal that goes away" anew python3 reliability/terminal.py close "${go[@]}"
        judge "going on" "$program" run --resume "$out" --quiet
        judge "the results" same_as_undisturbed "$out"
    else
        echo "a terminal that changes its size: SKIPPED, needs python3"
    fi
done
finish "terminals"
