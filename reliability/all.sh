#!/usr/bin/env bash
# All of them; the last lines of each are the counts of RELIABILITY.md. Some minutes.
cd "$(dirname "$0")"
bad=0
for script in kill signals full-disk read-only deleted terminal; do
    "./$script.sh" || bad=1
done
exit $bad
