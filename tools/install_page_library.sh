#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# install_page_library.sh FOLDER: puts what the page of `spa report` draws with (page/npm/package-lock.json: exact
# versions and their hashes) into FOLDER/node_modules unless it is there. The build goes on without it, and without
# the verb, so that a machine that cannot have it is told so and nothing fails.
set -eu

folder=$1
wanted=$(dirname -- "$0")/page/npm

if cmp -s "$wanted/package-lock.json" "$folder/package-lock.json" &&
    [ -e "$folder/node_modules/chart.js/dist/chart.umd.min.js" ]; then
    exit 0
fi
if ! command -v npm >/dev/null 2>&1; then
    echo "setup.sh: npm is not installed, so 'spa report' will not be built; install Node.js and npm" >&2
    exit 0
fi
mkdir -p "$folder"
cp "$wanted/package.json" "$wanted/package-lock.json" "$folder/"
printf '+ npm ci --prefix %s\n' "$folder" >&2
if ! npm ci --prefix "$folder" --ignore-scripts --no-audit --no-fund --loglevel=error >&2; then
    rm -f "$folder/package-lock.json"
    echo "setup.sh: npm could not install chart.js, so 'spa report' will not be built; see its message above" >&2
fi
