#!/usr/bin/env bash
# Compares the speed of two commits by paired runs: both are built, then measured in turns, so that what disturbs the machine
# disturbs both. Prints, for every row of `taut bench --quick`, the median of the ratios (new over old; above 1 is faster) and
# their range.
#
#   benches/compare.sh OLD NEW [RUNS [WORD...]]
#   benches/compare.sh main HEAD 9 tl-hourglass-free 3d
#
# RUNS is 5 if it is not given; the WORDs choose rows as those of `taut bench` do. Builds are kept in target/compare/COMMIT.
set -euo pipefail
if [ $# -lt 2 ] || ! [[ ${3:-5} =~ ^[1-9][0-9]*$ ]]; then
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0" >&2
    exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
runs=${3:-5}
words=("${@:4}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The full name of a commit.
named() {
    git rev-parse --verify --quiet "$1^{commit}" || { echo "error: there is no commit \`$1\`" >&2; exit 2; }
}

# Builds a commit; prints its program.
build() {
    local folder=$PWD/target/compare/$1
    if [ ! -x "$folder/release/taut" ]; then
        mkdir -p "$scratch/$1"
        git archive "$1" | tar -x -C "$scratch/$1"
        cargo build --release --locked --manifest-path "$scratch/$1/Cargo.toml" --target-dir "$folder" >&2
    fi
    "$folder/release/taut" bench --help >/dev/null 2>&1 || { echo "error: $1 has no \`taut bench\`" >&2; exit 2; }
    echo "$folder/release/taut"
}

# Speed of every row of a file: name@threads and particle-steps per second.
rows() {
    local key value name="" threads=""
    while IFS=: read -r key value; do
        value=${value%,}
        value=${value# }
        case ${key// /} in
            '"name"') name=${value//\"/} ;;
            '"threads"') threads=$value ;;
            '"particle_steps_per_second"') echo "$name@$threads $value" ;;
        esac
    done <"$1"
}

old_commit=$(named "$1")
new_commit=$(named "$2")
old=$(build "$old_commit")
new=$(build "$new_commit")
for ((run = 1; run <= runs; run++)); do
    echo "pair $run of $runs" >&2
    # Every other pair the other way round: the second of a pair finds a warmer machine.
    order=(old new)
    ((run % 2)) || order=(new old)
    for which in "${order[@]}"; do
        "${!which}" bench --quick ${words[@]+"${words[@]}"} --json "$scratch/$which-$run.json" >/dev/null 2>"$scratch/log" ||
            { cat "$scratch/log" >&2; exit 1; }
    done
    join <(rows "$scratch/old-$run.json" | sort) <(rows "$scratch/new-$run.json" | sort) >>"$scratch/pairs"
done
printf '%-58s %8s  %s\n' "row" "median" "range of $runs"
sort -s -k1,1 "$scratch/pairs" | awk '
    function tell(    i, j, x) {
        for (i = 2; i <= n; i++) {
            x = ratio[i]
            for (j = i - 1; j > 0 && ratio[j] > x; j--) ratio[j + 1] = ratio[j]
            ratio[j + 1] = x
        }
        x = n % 2 ? ratio[(n + 1) / 2] : (ratio[n / 2] + ratio[n / 2 + 1]) / 2
        if (n) printf "%-58s %8.3f  %.3f..%.3f\n", name, x, ratio[1], ratio[n]
    }
    $1 != name { tell(); name = $1; n = 0 }
    { ratio[++n] = $3 / $2 }
    END { tell() }'
