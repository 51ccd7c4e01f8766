#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing on Debian 12. The one place that knows the packages.
#   sh tools/setup.sh [build] [test] [ci]      without a group: build
# Asks dpkg first and runs apt-get only for what is missing, so a second run costs milliseconds.
set -eu

# One package a line; "package:command" counts as installed wherever the command is found, because
# Node.js often comes from elsewhere than Debian.
packages_of() {
    case $1 in
    build)
        # Compiler and build, then libraries. The last three let EGL and OSMesa draw without a GPU.
        cat <<'LIST'
g++
cmake
ninja-build
pkg-config
libcli11-dev
libdraco-dev
libegl-dev
libembree-dev
libgl-dev
libhwy-dev
libmeshoptimizer-dev
libopenimageio-dev
libopengl-dev
libopenmesh-dev
libosmesa6-dev
libtbb-dev
libtinygltf-dev
libxxhash-dev
libzstd-dev
nlohmann-json3-dev
libegl1
libegl-mesa0
libgl1-mesa-dri
LIST
        ;;
    test)
        # The last five: the tracing text on the GPU, which is Mesa's software Vulkan.
        cat <<'LIST'
gnuplot-nox
libgtest-dev
nodejs:node
npm:npm
python3:python3
zstd
glslang-tools
libvulkan-dev
mesa-vulkan-drivers
spirv-tools
vulkan-validationlayers
LIST
        ;;
    ci)
        cat <<'LIST'
ccache
clang
clang-format
clang-tidy
jq
libclang-rt-14-dev
shellcheck
LIST
        ;;
    *)
        echo "setup.sh: unknown group '$1'; the groups are build, test and ci" >&2
        exit 1
        ;;
    esac
}

# Prints those of the given entries that are not there.
missing_of() {
    for entry in "$@"; do
        package=${entry%%:*}
        case $entry in
        *:*) if command -v "${entry#*:}" >/dev/null 2>&1; then continue; fi ;;
        esac
        case $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true) in
        installed*) ;;
        *) printf '%s\n' "$package" ;;
        esac
    done
}

run() {
    printf '+ %s\n' "$*" >&2
    "$@"
}

# A mirror that fails once usually answers the next time.
run_with_retries() {
    for wait in 5 15 0; do
        if run "$@"; then return 0; fi
        if [ "$wait" -gt 0 ]; then
            echo "setup.sh: that failed; trying again in $wait s" >&2
            sleep "$wait"
        fi
    done
    return 1
}

[ $# -gt 0 ] || set -- build
entries=
for group in "$@"; do
    entries="$entries $(packages_of "$group")"
done

if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
    echo "setup.sh: this is not a Debian machine, so nothing is installed; needed are the equivalents of:" >&2
    # shellcheck disable=SC2086 # a list of words
    printf '  %s\n' $entries | sed 's/:.*//' >&2
    exit 0
fi

# shellcheck disable=SC2086 # a list of words
missing=$(missing_of $entries)
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
        echo "setup.sh: these packages are missing, and neither root nor sudo is there to install them:" >&2
        printf '%s\n' "$missing" | sed 's/^/  /' >&2
        exit 1
    fi
    as_root=sudo
fi

# A package source of the machine's owner that does not answer must not stop what the others can serve:
# the install below is what decides.
# shellcheck disable=SC2086 # nothing or one word
run_with_retries $as_root apt-get -qq -o Acquire::Retries=3 update ||
    echo "setup.sh: apt-get update failed; going on with the package lists that are there" >&2
# shellcheck disable=SC2086 # lists of words
if ! run_with_retries $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 install -y --no-install-recommends $missing; then
    echo "setup.sh: apt-get could not install: $(printf '%s ' $missing)" >&2
    echo "setup.sh: see its message above; the package lists need Debian 12 (bookworm)" >&2
    exit 1
fi
