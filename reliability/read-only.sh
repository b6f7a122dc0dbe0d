#!/usr/bin/env bash
# A directory that may not be written to, from the start or from some moment on. Needs root, to act as somebody who is not.
source "$(dirname "$0")/common.sh"
times=${1:-10}
[ "$(id -u)" = 0 ] && command -v setpriv >/dev/null || { echo "read-only directory: SKIPPED, needs root and setpriv"; exit 0; }
somebody=(setpriv --reuid 65534 --regid 65534 --clear-groups)
cp "$program" "$scratch/taut"
chmod 755 "$scratch" "$scratch/taut"
"${somebody[@]}" test -x "$scratch/taut" || { echo "read-only directory: SKIPPED, others cannot reach $scratch"; exit 0; }
undisturbed

mkdir "$scratch/closed"
chmod 755 "$scratch/closed"
status=0
"${somebody[@]}" "$scratch/taut" "${case[@]}" --out "$scratch/closed/run" >"$scratch/said" 2>&1 || status=$?
judge "from the start" failed_well "$scratch/said" 1 $status
judge "nothing is there" [ -z "$(ls -A "$scratch/closed")" ]

for i in $(seq "$times"); do
    home=$scratch/home-$i
    mkdir "$home"
    chown 65534 "$home"
    out=$home/run
    "${somebody[@]}" "$scratch/taut" "${case[@]}" --out "$out" --checkpoint-every 0.1 >"$scratch/said" 2>&1 &
    child=$!
    until [ -n "$(ls "$out/checkpoint" 2>/dev/null)" ]; do sleep 0.05; done
    sleep "$(random_time "$(echo "$lasts / 3" | bc -l)")"
    chmod 555 "$out" "$out/particles" "$out/checkpoint"
    status=0
    wait $child || status=$?
    judge "what is said" failed_well "$scratch/said" 1 $status
    judge "what is listed" listed_frames_are_whole "$out"
    chmod 755 "$out" "$out/particles" "$out/checkpoint"
    judge "going on" "${somebody[@]}" "$scratch/taut" run --resume "$out" --quiet
    judge "the results" same_as_undisturbed "$out"
done
finish "read-only directory"
