#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# build_with_pkg_config.sh PKG_CONFIG_DIR MAIN_CPP BINARY COMPILER [FLAG...]: builds and runs the program.
set -eu
PKG_CONFIG_PATH=$1
export PKG_CONFIG_PATH
source=$2
binary=$3
shift 3
# shellcheck disable=SC2046 # words of a command line
"$@" -std=c++20 $(pkg-config --cflags spa) "$source" -o "$binary" $(pkg-config --libs spa)
"$binary" "$binary.map.spa"
