#!/usr/bin/env bash
# Killed (kill -9) at random moments, and resumed until done: the same results bit by bit as an undisturbed run, and no torn file.
source "$(dirname "$0")/common.sh"
kills=${1:-50}
undisturbed
early=0 killed=0 round=0
while [ "$killed" -lt "$kills" ]; do
    round=$((round + 1))
    out=$scratch/round-$round
    said=$scratch/round-$round.txt
    : >"$said"
    status=137
    while [ "$status" = 137 ]; do
        threads=$((1 + RANDOM % 2))
        if [ -n "$(ls "$out/checkpoint" 2>/dev/null | grep '^step-.*\.taut$' || true)" ]; then
            command=(run --resume "$out")
        else
            [ ! -e "$out" ] || early=$((early + 1))
            rm -rf "$out"
            command=("${case[@]}" --out "$out")
        fi
        "$program" "${command[@]}" --threads $threads --checkpoint-every 0.05 >>"$said" 2>&1 &
        child=$!
        if [ "$killed" -lt "$kills" ]; then
            sleep "$(random_time "$(echo "$lasts / 3" | bc -l)")"
            if kill -9 $child 2>/dev/null; then
                killed=$((killed + 1))
            fi
        fi
        status=0
        wait $child 2>/dev/null || status=$?
        # What is listed must be whole at every moment.
        judge "frames after a kill" listed_frames_are_whole "$out"
    done
    judge "the end of a run" [ "$status" = 0 ]
    judge "the results of a run" same_as_undisturbed "$out"
    judge "no checkpoint was damaged" bash -c "! grep -E 'cannot be used|panicked' '$said'"
    rm -rf "$out"
done
echo "$killed kills in $round runs; $early before the first checkpoint (the case was begun again)"
finish "kill -9"
