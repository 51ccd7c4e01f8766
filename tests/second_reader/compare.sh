#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# compare.sh DUMP_SPA PYTHON READ_SPA: both readers on the same files.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" --write "$folder"
for kind in none zstd; do
    if [ "$kind" = zstd ] && ! command -v zstd >/dev/null; then
        echo "no zstd command: compressed files not compared"
        continue
    fi
    "$1" "$folder/$kind.spa" >"$folder/there.txt"
    "$2" "$3" "$folder/$kind.spa" --compare <"$folder/there.txt"
done
