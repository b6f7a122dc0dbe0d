#!/usr/bin/env bash
# How long do the runs take whose times the papers print? UL Table 2 (t = 1 s, dual and single criteria) and TL Table 3 (3 s of the bending
# column; the largest for 0.3 s, scaled). Prints a Markdown table with wall times and core-seconds beside the papers'.
#
#   benches/papers.sh [THREADS]        about twenty minutes on two cores; nothing else should run meanwhile
#
# UL: 32 cores (section 6 of the paper). TL: 8 cores, Intel i7-9700F (section 4.4).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
threads=${1:-$(nproc)}
cargo build --release --quiet
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# number NAME FILE: a number of a summary.
number() {
    grep -m1 "\"$1\"" "$2" | sed 's/.*: *//; s/,.*//'
}

# row TABLE PUBLISHED CORES SCALE CASE [OPTION...]: one run; its time times SCALE, beside the published one.
row() {
    local table=$1 published=$2 cores=$3 scale=$4
    shift 4
    rm -rf "$scratch/out"
    ./target/release/taut run "$@" --threads "$threads" --quiet --out "$scratch/out"
    awk -v table="$table" -v p="$published" -v cores="$cores" -v scale="$scale" -v t="$threads" \
        -v w="$(number wall_seconds "$scratch/out/summary.json")" -v n="$(number particles "$scratch/out/summary.json")" \
        -v steps="$(number steps "$scratch/out/summary.json")" 'BEGIN {
            w *= scale
            printf "| %s | %d | %.1f | %.0f | %.1f | %.0f | %.0f | %.1f |\n",
                table, n, w, w * t, p, p * cores, p * cores / (w * t), n * steps * scale / w / 1e6
        }'
}

echo "| run | particles | here, s | here, core-s | paper, s | paper, core-s | paper over here, core-s | Mps/s |"
echo "|---|---|---|---|---|---|---|---|"
quiet=(--set time.output=10 --set monitor.interval=10)
for line in "10 25.8 43.0" "20 66.3 139.5" "30 130.1 333.0"; do
    read -r resolution dual single <<<"$line"
    at=(--set "parameters.resolution=$resolution" --set time.end=1 "${quiet[@]}")
    row "UL Table 2, H/dp = $resolution, dual" "$dual" 32 1 ul-plate-2d "${at[@]}"
    row "UL Table 2, H/dp = $resolution, single" "$single" 32 1 ul-plate-2d "${at[@]}" --set 'stepping="single"'
done
for line in "6 3 1 5.10 4.98" "12 3 1 103.89 99.74" "24 0.3 10 1777.46 1746.83"; do
    read -r resolution end scale nested free <<<"$line"
    at=(--set "parameters.resolution=$resolution" --set "time.end=$end" --set 'time.step="paper"' "${quiet[@]}")
    row "TL Table 3, H/dp = $resolution, nested" "$nested" 8 "$scale" tl-bending-column "${at[@]}" --formulation tl-nested
    row "TL Table 3, H/dp = $resolution, hourglass-free" "$free" 8 "$scale" tl-bending-column "${at[@]}"
done
