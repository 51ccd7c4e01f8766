#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Bakes every sample with one thread and with two and compares the files byte by byte:
#   sh tools/check_threads.sh SPA          SPA = the command, for example build/release/tools/spa
set -eu
spa=${1:?"check_threads.sh: name the spa command"}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# compare NAME BAKE_OPTIONS...: of the sample $folder/NAME.glb
compared=0
compare() {
    name=$1
    shift
    for threads in 1 2; do
        "$spa" bake "$folder/$name.glb" -o "$folder/$threads.spa" --threads $threads "$@" >"$folder/said" 2>&1 || {
            cat "$folder/said" >&2
            echo "check_threads.sh: spa bake of $name $* --threads $threads failed" >&2
            exit 1
        }
    done
    if ! cmp "$folder/1.spa" "$folder/2.spa"; then
        echo "check_threads.sh: $name $*: one thread and two gave different bytes" >&2
        exit 1
    fi
    rm "$folder/1.spa" "$folder/2.spa"
    compared=$((compared + 1))
}

for name in boot sphere torus cube spiky cliff concave smooth; do
    case $name in
    boot) "$spa" sample boot --level 2 -o "$folder/boot.glb" >/dev/null ;;
    *) "$spa" sample "$name" -o "$folder/$name.glb" >/dev/null ;;
    esac
    for layers in 1 2; do
        compare "$name" --layers $layers --mapping octahedral --size 96
        compare "$name" --layers $layers --mapping latlong --size 128x96
    done
done
compare boot --baker orbit --gl osmesa --layers 2 --mapping octahedral --size 16
compare boot --baker orbit --gl osmesa --layers 2 --mapping latlong --size 24x16
compare boot --paper
echo "one thread and two gave the same bytes in all of $compared bakes"
