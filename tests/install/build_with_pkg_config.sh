#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# build_with_pkg_config.sh PKG_CONFIG_DIR PACKAGE MAIN_CPP BINARY COMPILER [FLAG...]: builds and runs the program.
set -eu
PKG_CONFIG_PATH=$1
export PKG_CONFIG_PATH
package=$2
source=$3
binary=$4
shift 4
# shellcheck disable=SC2046 # words of a command line
"$@" -std=c++20 $(pkg-config --cflags "$package") "$source" -o "$binary" $(pkg-config --libs "$package")
"$binary" "$binary.map.spa"
