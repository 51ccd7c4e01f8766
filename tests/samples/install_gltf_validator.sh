#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# install_gltf_validator.sh FOLDER: puts Khronos's gltf-validator into FOLDER/node_modules unless it is there.
# Exits 77 (skipped) where it cannot be had: no npm, or no package registry.
set -eu

folder=$1
version=2.0.0-dev.3.10

if grep -qs "\"version\": \"$version\"" "$folder/node_modules/gltf-validator/package.json"; then exit 0; fi
if ! command -v npm >/dev/null 2>&1; then
    echo "skipped: npm is not installed, so gltf-validator cannot be; install Node.js and npm" >&2
    exit 77
fi
mkdir -p "$folder"
if ! npm install --prefix "$folder" --no-audit --no-fund --loglevel=error "gltf-validator@$version"; then
    echo "skipped: npm could not install gltf-validator@$version; see its message above" >&2
    exit 77
fi
