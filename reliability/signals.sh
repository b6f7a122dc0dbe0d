#!/usr/bin/env bash
# Ctrl-C and requests to end at random moments: a checkpoint of that step and a message how to go on; then resumed until done, to the same
# results. A second signal ends the program at once.
source "$(dirname "$0")/common.sh"
signals=${1:-50}
undisturbed
stopped=0 round=0
while [ "$stopped" -lt "$signals" ]; do
    round=$((round + 1))
    out=$scratch/round-$round
    command=("${case[@]}" --out "$out")
    status=130
    while [ "$status" = 130 ] || [ "$status" = 143 ]; do
        "$program" "${command[@]}" --threads $((1 + RANDOM % 2)) >"$scratch/said" 2>&1 &
        child=$!
        if [ "$stopped" -lt "$signals" ]; then
            sleep 0.1
            sleep "$(random_time "$(echo "$lasts / 3" | bc -l)")"
            if [ $((RANDOM % 2)) = 0 ]; then signal=INT wanted=130; else signal=TERM wanted=143; fi
            if kill -$signal $child 2>/dev/null; then stopped=$((stopped + 1)); fi
        fi
        status=0
        wait $child || status=$?
        if [ "$status" != 0 ]; then
            judge "the status of a stop" [ "$status" = $wanted ]
            judge "what is said" grep -q "to go on: taut run --resume $out" "$scratch/said"
        fi
        command=(run --resume "$out")
    done
    judge "the end of a run" [ "$status" = 0 ]
    judge "the results of a run" same_as_undisturbed "$out"
    rm -rf "$out"
done

# A run whose step takes long, so that the second signal comes while the first waits for its end.
for i in $(seq 5); do
    out=$scratch/twice
    rm -rf "$out"
    "$program" run ul-plate-2d --set parameters.resolution=150 --out "$out" --threads 1 >"$scratch/said" 2>&1 &
    child=$!
    sleep 0.3
    kill -INT $child
    # Two signals at the same moment are one for the system.
    sleep 0.2
    judge "it waits for the step" kill -INT $child
    sleep 0.5
    judge "it has ended" bash -c "! kill -0 $child 2>/dev/null"
    status=0
    wait $child || status=$?
    judge "the status of a second signal" [ "$status" = 130 ]
done
echo "$stopped signals in $round runs"
finish "signals"
