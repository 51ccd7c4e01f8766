#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# compare_load.sh BUILD_DIR ASSET [RUNS]: times `spa bake ASSET` (plain centre and frame) as a whole process against one that only loads
# the asset (tests/bake/load_reference.cpp), in turns, and prints both medians and their ratio.
set -eu
if [ $# -lt 2 ]; then
    echo "usage: sh tools/compare_load.sh BUILD_DIR ASSET [RUNS]" >&2
    exit 1
fi
build=$1
asset=$2
runs=${3:-11}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# milliseconds FILE COMMAND...: appends how long the command took.
milliseconds() {
    times=$1
    shift
    start=$(date +%s%N)
    "$@" > /dev/null
    end=$(date +%s%N)
    echo $(((end - start) / 10000)) >> "$times"
}
median() {
    sort -n "$1" | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 200 }'
}

for method in load bake-1 bake-2; do : > "$folder/$method"; done
run=0
while [ "$run" -lt "$runs" ]; do
    milliseconds "$folder/load" "$build/tests/bake/load_reference" "$asset"
    for layers in 1 2; do
        milliseconds "$folder/bake-$layers" "$build/tools/spa" bake "$asset" -o "$folder/a.spa" --layers $layers \
            --center bounds --frame sphere -q
    done
    run=$((run + 1))
done
load=$(median "$folder/load")
printf '%-20s %8s %6s\n' "$(basename "$asset")" ms ratio
printf '%-20s %8.1f\n' "load" "$load"
for layers in 1 2; do
    bake=$(median "$folder/bake-$layers")
    printf '%-20s %8.1f %6.2f\n' "bake, $layers layer(s)" "$bake" "$(echo "$bake $load" | awk '{ print $1 / $2 }')"
done
