#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What CI cannot do for Direct3D, because it takes Wine and a download of 113 MB:
#   sh tools/check_hlsl.sh [FOLDER]
#   1. compiles shaders/hlsl and the ray query of docs/directx.md to DXIL with a real DXC;
#   2. compiles shaders/hlsl and its test shaders to SPIR-V with it, and validates that;
#   3. traces that SPIR-V on Mesa's software Vulkan, as ray-tracing pipelines and ray queries, against the CPU;
#   4. compiles the Direct3D loader, the container and what they use with MinGW-w64.
# FOLDER (default: ${XDG_CACHE_HOME:-~/.cache}/spa-check-hlsl) keeps the compiler and what it makes; nothing is written
# to the source tree but build/release. DXC is the dxcompiler.dll (NCSA licence) that the npm package onnxruntime-node
# (MIT) has beside it.
set -eu
unset CDPATH
folder=${1:-${XDG_CACHE_HOME:-$HOME/.cache}/spa-check-hlsl}
mkdir -p "$folder"
folder=$(cd -- "$folder" && pwd)
cd -- "$(dirname -- "$0")/.."

package=onnxruntime-node@1.30.0
dll=package/bin/napi-v6/win32/x64/dxcompiler.dll
dll_sum=593d42df78c7f9cbd97c1374af107cfe20985759f98b77afc1448fe41ee3cc76

sh tools/setup.sh build test hlsl

# --- The compiler

if [ ! -e "$folder/dxcompiler.dll" ]; then
    echo "== $package"
    archive=$(cd "$folder" && npm pack --silent "$package")
    tar -xzf "$folder/$archive" -C "$folder" --strip-components=5 "$dll"
    rm "$folder/$archive"
fi
if ! echo "$dll_sum  $folder/dxcompiler.dll" | sha256sum --check --quiet; then
    echo "check_hlsl.sh: $folder/dxcompiler.dll is not the one of $package; remove it and try again" >&2
    exit 2
fi
mingw=x86_64-w64-mingw32-g++-posix
$mingw -std=c++20 -O1 -Wall -Wextra -Werror -municode -static -o "$folder/dxc_driver.exe" tools/dxc_driver.cpp
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
export WINEPREFIX="$folder/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml='

# dxc OUTPUT SOURCE OPTION...
dxc() {
    "$wine" "$folder/dxc_driver.exe" "$@" -Gis -WX -I shaders/hlsl
}
echo "== DXC $("$wine" "$folder/dxc_driver.exe" --version 2>/dev/null | tr -d '\r')"

# The tracers that are tried, by the names of the cases of tests/gpu/loader_test.cpp, and their macros.
tracers='projective fan fan_by_distance sphere march'
macros_of() {
    case $1 in
    projective) ;;
    fan) echo -D SPA_METHOD=SPA_FAN -D SPA_COUNT=10 ;;
    fan_by_distance) echo -D SPA_METHOD=SPA_FAN -D SPA_COUNT=50 -D SPA_COUNT_RULE=SPA_FAN_BY_DISTANCE ;;
    sphere) echo -D SPA_METHOD=SPA_FAN -D SPA_COUNT=0 ;;
    march) echo -D SPA_METHOD=SPA_MARCH -D SPA_COUNT=32 ;;
    esac
}

# --- DXIL

# Containers begin with DXBC and a hash, which is zero unless DXC's validator has passed what is in them.
report_dxil() {
    hash=$(od -A n -t x1 -j 4 -N 16 "$1" | tr -d ' ')
    if [ "$(head -c 4 "$1")" != DXBC ] || [ "$hash" = 00000000000000000000000000000000 ]; then
        echo "check_hlsl.sh: $1 is no validated DXIL" >&2
        exit 1
    fi
    printf '%-36s %7d bytes, validated\n' "${1##*/}" "$(wc -c <"$1")"
}

echo "== DXIL"
cmake -DPAGE=docs/directx.md -DLANGUAGE=hlsl "-DOUTPUT=$folder/page.hlsl" -P tests/gpu/page_snippet.cmake
for tracer in $tracers; do
    # shellcheck disable=SC2046 # words
    dxc "$folder/$tracer.dxil" shaders/hlsl/spa.hlsl -T lib_6_5 $(macros_of "$tracer")
    report_dxil "$folder/$tracer.dxil"
done
printf 'struct Own { float t; };\n#include "spa.hlsl"\n' >"$folder/own_payload.hlsl"
dxc "$folder/own_payload.dxil" "$folder/own_payload.hlsl" -T lib_6_5 -D SPA_PAYLOAD=Own -D SPA_STAGES=5
report_dxil "$folder/own_payload.dxil"
dxc "$folder/ray_query.dxil" "$folder/page.hlsl" -T cs_6_5 -E main
report_dxil "$folder/ray_query.dxil"

# --- SPIR-V

# spirv OUTPUT SOURCE OPTION...
spirv() {
    dxc "$@" -spirv -fspv-target-env=vulkan1.3
    spirv-val --target-env vulkan1.3 --scalar-block-layout "$1"
}

echo "== SPIR-V"
for tracer in $tracers; do
    out=$folder/spirv/$tracer
    mkdir -p "$out"
    # shellcheck disable=SC2046 # words
    set -- $(macros_of "$tracer")
    # The tests call every entry point main.
    spirv "$out/spa.rint.spv" shaders/hlsl/spa.hlsl -T lib_6_5 -D SPA_STAGES=1 -D spa_intersection=main "$@"
    spirv "$out/spa.rchit.spv" shaders/hlsl/spa.hlsl -T lib_6_5 -D SPA_STAGES=2 -D spa_closest_hit=main "$@"
    spirv "$out/spa.rahit.spv" shaders/hlsl/spa.hlsl -T lib_6_5 -D SPA_STAGES=4 -D spa_any_hit=main "$@"
    spirv "$out/map_query.comp.spv" tests/gpu/shaders/map_query.hlsl -T cs_6_5 -E main "$@"
    spirv "$out/map_pipeline.rgen.spv" tests/gpu/shaders/map_pipeline.hlsl -T lib_6_5 -D RAYGEN
    spirv "$out/map_pipeline.rmiss.spv" tests/gpu/shaders/map_pipeline.hlsl -T lib_6_5 -D MISS
    printf '%-36s %7d bytes in %d modules, valid\n' "$tracer" "$(cat "$out"/*.spv | wc -c)" \
        "$(find "$out" -name '*.spv' | wc -l)"
done

echo "== Rays against the CPU"
if command -v ccache >/dev/null 2>&1; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; else launcher=; fi
# shellcheck disable=SC2086 # a word, or nothing
cmake --preset release -DSPA_BUILD_TESTS=ON $launcher >/dev/null
cmake --build build/release --target gpu_tests --parallel "$(nproc)" >/dev/null
VK_DRIVER_FILES=$(find /usr/share/vulkan/icd.d /usr/local/share/vulkan/icd.d -name 'lvp_icd*.json' 2>/dev/null | head -n 1)
export VK_DRIVER_FILES SPA_REQUIRE_VULKAN=1
for tracer in $tracers; do
    filter=Methods/LoadedMaps.AreHitAsOnTheCpu/$tracer
    [ "$tracer" != projective ] || filter=$filter:Loader.CoverageLetsRaysThrough:Loader.RecordFlagsCull
    if ! SPA_MAP_SHADERS=$folder/spirv/$tracer build/release/tests/gpu/gpu_tests --gtest_filter="$filter" \
        >"$folder/$tracer.log" 2>&1; then
        cat "$folder/$tracer.log" >&2
        exit 1
    fi
    sed -n "s/^  /$tracer, /p" "$folder/$tracer.log"
    # Nothing that was meant to run is missing.
    if grep -q -e SKIPPED -e 'Running 0 tests' "$folder/$tracer.log"; then
        cat "$folder/$tracer.log" >&2
        exit 1
    fi
done

# --- The loader on Windows

echo "== MinGW-w64, $($mingw -dumpfullversion)"
# Headers that know of no operating system, apart from those of Linux beside them.
headers=$folder/include
mkdir -p "$headers"
for header in directx zstd.h xxhash.h; do ln -sfn "/usr/include/$header" "$headers/$header"; done
count=0
for source in libspa/core/*.cpp libspa/dxr/*.cpp libspa/trace/map_*.cpp libspa/trace/node_pyramid.cpp \
    libspa/trace/packed_images.cpp libspa/trace/trace_map.cpp formats/container/*.cpp; do
    [ "$source" != formats/container/file_io_posix.cpp ] || continue
    $mingw -std=c++20 -O2 -Wall -Wextra -Wconversion -Werror -ffp-contract=off -isystem "$headers" -c \
        -o "$folder/object.o" "$source"
    count=$((count + 1))
done
echo "$count source files of the loader, the container and what they use compile without a warning"
echo "== All is well"
