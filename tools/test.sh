#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need, builds everything and runs every test. Arguments go on to ctest, for
# example: sh tools/test.sh -R container
#
# SPA_CMAKE_ARGS holds further options for CMake, divided by spaces.
set -eu
unset CDPATH
cd -- "$(dirname -- "$0")/.."

run() {
    printf '+ %s\n' "$*"
    "$@"
}

run sh tools/setup.sh build test

if command -v ccache >/dev/null 2>&1; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; else launcher=; fi
# shellcheck disable=SC2086 # words, or nothing
run cmake --preset release -DSPA_BUILD_TESTS=ON $launcher ${SPA_CMAKE_ARGS-}
run cmake --build --preset release --parallel "$(nproc)"
run ctest --preset release --parallel 2 "$@"
