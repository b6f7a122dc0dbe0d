#!/usr/bin/env bash
# Measures this machine and puts the tables into docs/performance.md, between its marks. Let nothing else run meanwhile.
#
#   benches/table.sh [OPTION...]      options as those of `taut bench`
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
page=docs/performance.md
tables=$(mktemp)
trap 'rm -f "$tables"' EXIT
cargo build --release --locked
target/release/taut bench --markdown "$@" >"$tables"
begin='<!-- bench: begin -->' end='<!-- bench: end -->'
grep -qxF -- "$begin" "$page" && grep -qxF -- "$end" "$page" || { echo "error: $page has no marks" >&2; exit 1; }
printed=$(sed "/^$begin\$/q" "$page"; cat "$tables"; sed -n "/^$end\$/,\$p" "$page")
printf '%s\n' "$printed" >"$page"
