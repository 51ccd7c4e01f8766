#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fuzzes one target for as long as you like, going on from what earlier runs kept:
#   sh tools/fuzz.sh TARGET SECONDS [BUILD_DIR [OPTION...]]
# TARGET: container, trace, gltf, obj, ply, stl, off or picture. BUILD_DIR: made with the preset asan, clang and
# SPA_BUILD_FUZZERS (build/asan if not given). OPTION: of libFuzzer. Goes on after a crash, a hang or an input that
# takes too much memory; each is written to BUILD_DIR/tests/fuzz/TARGET-crash-..., -timeout-... or -oom-..., and the
# status is then 1.
set -eu
unset CDPATH
cd -- "$(dirname -- "$0")/.."
if [ $# -lt 2 ]; then
    sed -n 's/^#   \(sh .*\)/usage: \1/p' "$0" >&2
    exit 1
fi
target=$1
seconds=$2
build=${3:-build/asan}
[ $# -lt 3 ] && shift 2 || shift 3
cmake --build "$build" --target "${target}_fuzzer"

tests() { ctest --test-dir "$build" --show-only=json-v1 --tests-regex "$1"; }
ctest --test-dir "$build" --fixture-setup '.*' --tests-regex '^Fuzz\.Seeds' --output-on-failure >/dev/null 2>&1 || true
command=$(tests "^Fuzz\\.$target\$" | jq -r '.tests[] | select(.name == "Fuzz.'"$target"'").command | @sh')
folder=$build/tests/fuzz
found() { find "$folder" -maxdepth 1 -name "$target-crash-*" -o -maxdepth 1 -name "$target-timeout-*" \
    -o -maxdepth 1 -name "$target-oom-*" | sort; }
before=$(found)
export UBSAN_OPTIONS=print_stacktrace=1
eval "nice -n 19 $command -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 \
    -max_total_time=$seconds" '"$@"' || true
[ "$(found)" = "$before" ] || { found; exit 1; }
