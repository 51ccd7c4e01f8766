#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# compare_bakers.sh BUILD_DIR ASSET_DIR: bakes every asset of a folder with both bakers, one layer and two, and
# prints how far they agree. Exit code 6 if a figure misses the bar, 3 if an asset could not be baked.
set -eu
if [ $# -ne 2 ]; then
    echo "usage: sh tools/compare_bakers.sh BUILD_DIR ASSET_DIR" >&2
    exit 1
fi
case $1 in
/*) table=$1/tests/bake/bakers_table ;;
*) table=$PWD/$1/tests/bake/bakers_table ;;
esac
cd -- "$2"
find . -type f \( -iname '*.gltf' -o -iname '*.glb' -o -iname '*.obj' -o -iname '*.ply' -o -iname '*.stl' \
    -o -iname '*.off' \) -print0 | LC_ALL=C sort -z | xargs -0 "$table"
