#!/usr/bin/env bash
# Results that are deleted while the run goes on: all of them, or a part.
source "$(dirname "$0")/common.sh"
times=${1:-10}
undisturbed

# Deletes, however much is written meanwhile.
delete() {
    until rm -rf "$1" 2>/dev/null; do :; done
}

# Begins a run, and waits for a random moment of it.
begin() {
    out=$scratch/run
    rm -rf "$out"
    "$program" "${case[@]}" --out "$out" --checkpoint-every 0.1 >"$scratch/said" 2>&1 &
    child=$!
    until [ -n "$(ls "$out/checkpoint" 2>/dev/null)" ]; do sleep 0.05; done
    sleep "$(random_time "$(echo "$lasts / 3" | bc -l)")"
}

for i in $(seq "$times"); do
    # The whole directory: the next frame has nowhere to go. Nothing may be made again in its place.
    begin
    delete "$out"
    status=0
    wait $child || status=$?
    judge "everything" failed_well "$scratch/said" 1 $status
    judge "nothing is made again" [ ! -e "$out" ]

    # The checkpoints: they are made again, and the run ends well.
    begin
    delete "$out/checkpoint"
    status=0
    wait $child || status=$?
    judge "checkpoints" [ "$status" = 0 ]
    judge "the results" same_as_undisturbed "$out"

    # A frame, and then the run is stopped: it cannot go on to complete results, and says so.
    begin
    rm "$out/particles/particles_000000.vtp"
    kill -INT $child
    wait $child || true
    status=0
    "$program" run --resume "$out" >"$scratch/said" 2>&1 || status=$?
    judge "a frame" failed_well "$scratch/said" 2 $status
    judge "which" grep -q 'particles_000000.vtp: it is missing' "$scratch/said"
done
finish "deleted results"
