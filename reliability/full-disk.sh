#!/usr/bin/env bash
# A disk that is full at one moment or another: the run ends with the cause and a hint, what is listed is whole, and when there is room
# again it goes on to the same results. Needs root: the disk is a small file system in memory.
source "$(dirname "$0")/common.sh"
sizes=${1:-20}
[ "$(id -u)" = 0 ] || { echo "full disk: SKIPPED, needs root to mount a small file system"; exit 0; }
disk=$scratch/disk
mkdir "$disk"
mount -t tmpfs -o size=64k none "$disk" 2>/dev/null || { echo "full disk: SKIPPED, cannot mount"; exit 0; }
mounted+=("$disk")
undisturbed
whole=$(du -sk "$scratch/whole" | cut -f1)
resumed=0
for i in $(seq "$sizes"); do
    out=$disk/run
    rm -rf "$disk"/*
    # From next to nothing to nine tenths of what is needed.
    mount -o "remount,size=$((16 + whole * 9 * i / sizes / 10))k" "$disk"
    status=0
    "$program" "${case[@]}" --out "$out" --checkpoint-every 0.1 >"$scratch/said" 2>&1 || status=$?
    judge "what is said" failed_well "$scratch/said" 1 $status
    judge "what is listed" listed_frames_are_whole "$out"
    mount -o remount,size=200m "$disk"
    if grep -q -- '--resume' "$scratch/said"; then
        resumed=$((resumed + 1))
        judge "going on" "$program" run --resume "$out" --quiet
        judge "the results" same_as_undisturbed "$out"
    fi
done
echo "$sizes disks, $resumed with a checkpoint to go on from"
finish "full disk"
