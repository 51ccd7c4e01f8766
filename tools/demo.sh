#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# From nothing to a baked boot: installs what is missing, builds, makes a sample, bakes it and shows it.
# Run again it does nothing twice.
set -eu
unset CDPATH
cd -- "$(dirname -- "$0")/.."

run() {
    printf '+ %s\n' "$*"
    "$@"
}

# is_newer FILE THAN...: FILE exists and was written after each of the others.
is_newer() {
    file=$1
    shift
    for other in "$@"; do
        [ -n "$(find "$file" -newer "$other" 2>/dev/null)" ] || return 1
    done
}

build=build/release
spa=$build/tools/spa
out=out

run sh tools/setup.sh build

# Only the first time: a build folder that tools/test.sh made stays as it is, tests included.
if [ ! -f $build/build.ninja ]; then
    set -- -DSPA_BUILD_TESTS=OFF
    if command -v ccache >/dev/null 2>&1; then set -- "$@" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
    run cmake --preset release "$@"
fi
run cmake --build --preset release --target spa --parallel "$(nproc)"

mkdir -p $out
if is_newer $out/boot.glb $spa; then
    echo "= $out/boot.glb is up to date"
else
    run $spa sample boot --level 3 -o $out/boot.glb
fi
if is_newer $out/boot.spa $out/boot.glb $spa; then
    echo "= $out/boot.spa is up to date"
else
    run $spa bake $out/boot.glb -o $out/boot.spa
fi
run $spa inspect $out/boot.spa
if is_newer $out/boot.png $out/boot.spa $spa; then
    echo "= $out/boot.png is up to date"
else
    run $spa inspect --sheet $out/boot.png $out/boot.spa >/dev/null
fi

# Where npm could be had (tools/install_page_library.sh).
report=
if $spa help report >/dev/null 2>&1; then
    report="
  a page about it    $PWD/$out/report.html"
    if is_newer $out/report.html $out/boot.spa $spa; then
        echo "= $out/report.html is up to date"
    else
        run $spa report $out/boot.spa -o $out/report.html
    fi
fi

cat <<END

Here is everything:
  the command        $PWD/$spa   ($spa help)
  the sample boot    $PWD/$out/boot.glb
  its spherical map  $PWD/$out/boot.spa
  its maps as one    $PWD/$out/boot.png
  picture$report
END
