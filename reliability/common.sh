# What the scripts of this folder share: the program, the case, an undisturbed run to compare with, and the count at the end.
# Each script does to a run what can happen to one, many times, and says how often it went as it must. They need Linux, some as root;
# what cannot be done here is skipped with a message.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${TAUT:-$PWD/target/release/taut}
[ -x "$program" ] || { echo "build it first: cargo build --release"; exit 2; }
scratch=$(mktemp -d)
mounted=()
cleanup() {
    for place in "${mounted[@]}"; do umount -l "$place" 2>/dev/null || true; done
    rm -rf "$scratch"
}
trap cleanup EXIT
# A run of a second or some, with a table, 26 frames and a few megabytes of results.
case=(run ul-plate-2d --set time.end=0.05 --set time.output=0.002)
tries=0
good=0

# The run that nothing happens to, in $scratch/whole; its wall time in seconds is $lasts.
undisturbed() {
    local begun
    begun=$(date +%s.%N)
    "$program" "${case[@]}" --quiet --out "$scratch/whole"
    lasts=$(echo "$(date +%s.%N) - $begun" | bc)
}

# A random time up to $1 seconds.
random_time() {
    echo "scale=4; $1 * $RANDOM / 32768" | bc
}

# Whether frames, tables, pictures and the numbers of the summary are those of the undisturbed run, and nothing else is left.
same_as_undisturbed() {
    diff -rq -x summary.json -x manifest.json -x checkpoint "$scratch/whole" "$1" &&
        diff <(numbers "$scratch/whole") <(numbers "$1") && nothing_torn "$1"
}

numbers() {
    grep -v -E '"(wall_seconds|particle_steps_per_second|threads|checkpoints|checkpoint_seconds)"' "$1/summary.json"
}

nothing_torn() {
    local left
    left=$(find "$1" -name '.unfinished-*' -o -name '*.damaged')
    [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}

# Whether the frames that are listed in $1 are, bit by bit, those of the undisturbed run.
listed_frames_are_whole() {
    local file
    [ -e "$1/particles/particles.pvd" ] || return 0
    for file in $(grep -o 'particles_[0-9]*\.vtp' "$1/particles/particles.pvd"); do
        cmp "$1/particles/$file" "$scratch/whole/particles/$file" || return 1
    done
}

# Counts a try: `judge NAME COMMAND...` is good if the command is.
judge() {
    local name=$1
    shift
    tries=$((tries + 1))
    if "$@"; then good=$((good + 1)); else echo "BAD: $name (try $tries)"; fi
}

# A run that must fail: status $2 (or another if it is wrong), a cause, a hint, no panic; what it said is in $1.
failed_well() {
    [ "$3" = "$2" ] || { echo "status $3 instead of $2"; cat "$1"; return 1; }
    ! grep -q panicked "$1" && grep -q '^error: ' "$1" && grep -q '^hint: ' "$1" || { cat "$1"; return 1; }
}

finish() {
    echo "$1: $good of $tries as they must be"
    [ "$good" = "$tries" ]
}
