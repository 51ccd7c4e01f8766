#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# check_links.sh [--tracer] BINARY...: what a program that only reads `.spa` files may need at run time is the C++
# run-time library and zstd, and one that traces Highway and oneTBB; no OpenMesh, OpenImageIO, tinygltf, EGL or
# Embree, linked in or needed.
set -eu
status=0
tracer=no
if [ "$1" = --tracer ]; then
    tracer=yes
    shift
fi
for binary in "$@"; do
    needed=$(ldd "$binary" | awk '{ print $1 }')
    for library in $needed; do
        case ${library##*/} in
        linux-vdso.so* | linux-gate.so* | ld-linux*.so* | libc.so* | libm.so* | libgcc_s.so* | libstdc++.so* | \
            libpthread.so* | libzstd.so* | libasan.so* | libubsan.so* | libdl.so* | librt.so*) ;;
        libhwy.so* | libtbb.so*)
            if [ $tracer = no ]; then
                echo "$binary may not need $library"
                status=1
            fi
            ;;
        *)
            echo "$binary may not need $library"
            status=1
            ;;
        esac
    done
    if nm -C "$binary" | grep -E 'OpenMesh::|OpenImageIO|tinygltf::|draco::|meshopt_| egl[A-Z]|rtc[A-Z]|spa::mesh'; then
        echo "$binary holds symbols that only tools need"
        status=1
    fi
done
exit $status
