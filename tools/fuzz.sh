#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fuzzes one target for as long as you like, going on from what earlier runs kept:
#   sh tools/fuzz.sh TARGET SECONDS [BUILD_DIR [OPTION...]]
# TARGET: container, trace, gltf, obj, ply, stl, off or picture. BUILD_DIR: configured with the preset asan, clang and
# SPA_BUILD_FUZZERS (build/asan if not given). OPTION: of libFuzzer. Does not stop at what breaks a promise, hangs or
# takes too much memory: each such input is kept, its path is printed at the end, and the status is 1.
set -eu
unset CDPATH
cd -- "$(dirname -- "$0")/.."

if [ $# -lt 2 ]; then
    echo 'usage: sh tools/fuzz.sh TARGET SECONDS [BUILD_DIR [OPTION...]]' >&2
    exit 1
fi
target=$1
seconds=$2
build=${3:-build/asan}
if [ $# -gt 3 ]; then shift 3; else shift $#; fi

programs="${target}_fuzzer"
case $target in
container) programs="$programs container_seeds" ;;
trace) ;;
*) programs="$programs import_seeds" ;;
esac
# shellcheck disable=SC2086 # a list
cmake --build "$build" --target $programs
ctest --test-dir "$build" --tests-regex '^Fuzz\.Seeds\.' --output-on-failure >/dev/null || true # those that are built

command=$(ctest --test-dir "$build" --show-only=json-v1 --tests-regex "^Fuzz\\.$target\$" |
    jq -r '.tests[] | select(.command[0] | endswith("_fuzzer")) | .command | @sh')
if [ -z "$command" ]; then
    echo "tools/fuzz.sh: $build has no fuzzer '$target'" >&2
    exit 1
fi
folder=$build/tests/fuzz
found() {
    find "$folder" -maxdepth 1 \( -name "$target-crash-*" -o -name "$target-timeout-*" -o -name "$target-oom-*" \
        -o -name "$target-leak-*" \) | sort
}
before=$(found)
export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS="suppressions=$PWD/tests/fuzz/leaks.supp:print_suppressions=0"
# Of an option that is given twice the last counts.
eval "nice -n 19 $command" -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 \
    -max_total_time="$seconds" '"$@"' || true
after=$(found)
if [ "$after" != "$before" ]; then
    printf 'kept:\n%s\n' "$after"
    exit 1
fi
