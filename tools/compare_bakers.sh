#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# compare_bakers.sh BUILD_DIR ASSET_DIR [--gl egl|osmesa] [--size N] [--mapping octahedral|latlong]: bakes every
# asset of a folder with both bakers and with Embree's rays, one layer and two, and prints how far they agree; small
# files first, folders named malformed left out. Exit code 6 if a figure misses the bar, 4 if a caster fails.
set -eu
if [ $# -lt 2 ]; then
    echo "usage: sh tools/compare_bakers.sh BUILD_DIR ASSET_DIR [--gl egl|osmesa] [--size N]" \
        "[--mapping octahedral|latlong]" >&2
    exit 1
fi
case $1 in
/*) table=$1/tests/bake/bakers_table ;;
*) table=$PWD/$1/tests/bake/bakers_table ;;
esac
cd -- "$2"
shift 2
find . -name malformed -prune -o -type f \( -iname '*.gltf' -o -iname '*.glb' -o -iname '*.obj' -o -iname '*.ply' \
    -o -iname '*.stl' -o -iname '*.off' \) -printf '%s %P\0' | LC_ALL=C sort -z -n | cut -z -d ' ' -f 2- |
    xargs -0 -x -n 10000 "$table" "$@"
