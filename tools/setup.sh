#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing on Debian 12. The one place that knows the packages.
#   sh tools/setup.sh [build] [test] [ci] [hlsl]      without a group: build; hlsl: for tools/check_hlsl.sh
# Asks dpkg first and runs apt-get only for what is missing, so a second run costs milliseconds.
set -eu

# One package a line; "package:command" counts as installed wherever the command is found, because
# Node.js often comes from elsewhere than Debian; "package>=version" wants at least that version, from
# bookworm-backports where the release itself has an older one.
packages_of() {
    case $1 in
    build)
        # Compilers and build, then libraries. The last three let EGL and OSMesa draw without a GPU. npm is for
        # what the page of spa report draws with (install_page_library.sh).
        cat <<'LIST'
g++
cmake
ninja-build
pkg-config
glslang-tools
spirv-tools
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
libvulkan-dev
libxxhash-dev
libzstd-dev
nlohmann-json3-dev
nodejs:node
npm:npm
libegl1
libegl-mesa0
libgl1-mesa-dri
LIST
        ;;
    test)
        # The last three: Vulkan and Direct3D. The device is Mesa's software one, which traces rays since 24.1.
        cat <<'LIST'
chromium
gnuplot-nox
libgtest-dev
python3:python3
python3-yaml
zstd
mesa-vulkan-drivers>=25
directx-headers-dev
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
lld
munge
shellcheck
slurm-client
slurmctld
slurmd
LIST
        ;;
    hlsl)
        cat <<'LIST'
g++-mingw-w64-x86-64-posix
wine64
LIST
        ;;
    *)
        echo "setup.sh: unknown group '$1'; the groups are build, test, ci and hlsl" >&2
        exit 1
        ;;
    esac
}

# Prints those of the given entries that are not there.
missing_of() {
    for entry in "$@"; do
        package=${entry%%[:>]*}
        lowest=0
        case $entry in
        *:*) if command -v "${entry#*:}" >/dev/null 2>&1; then continue; fi ;;
        *'>='*) lowest=${entry#*>=} ;;
        esac
        installed=$(dpkg-query -W -f='${db:Status-Status} ${Version}' "$package" 2>/dev/null || true)
        case $installed in
        'installed '*) if dpkg --compare-versions "${installed#* }" ge "$lowest"; then continue; fi ;;
        esac
        printf '%s\n' "${entry%:*}"
    done
}

# Makes bookworm-backports known to apt, from the mirror that it already uses.
add_backports() {
    list=/etc/apt/sources.list.d/spa-backports.list
    [ ! -e "$list" ] || return 0
    # shellcheck disable=SC2016 # apt-get fills it in
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Codename: bookworm' 'Created-By: Packages' | head -n 1)
    if [ -z "$mirror" ]; then
        echo "setup.sh: apt knows no mirror of Debian 12 (bookworm), and its own version is too old" >&2
        return 1
    fi
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    printf 'deb [signed-by=%s] %s bookworm-backports main\n' "$keyring" "$mirror" |
        $as_root tee "$list" >/dev/null
    run_with_retries $as_root apt-get -qq -o Acquire::Retries=3 update
}

# What to tell apt-get for an entry of missing_of.
apt_name() {
    case $1 in
    *'>='*)
        package=${1%>=*}
        candidate=$(apt-cache policy "$package" | sed -n 's/^ *Candidate: //p')
        if dpkg --compare-versions "$candidate" lt "${1#*>=}"; then
            add_backports && printf '%s/bookworm-backports\n' "$package"
        else
            printf '%s\n' "$package"
        fi
        ;;
    *) printf '%s\n' "$1" ;;
    esac
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

# What is not Debian's: into build/npm, which is found there.
install_others() {
    folder=$(dirname -- "$0")
    for group in "$@"; do
        if [ "$group" = build ]; then sh "$folder/install_page_library.sh" "$folder/../build/npm"; fi
    done
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
    install_others "$@"
    exit 0
fi

# shellcheck disable=SC2086 # a list of words
missing=$(missing_of $entries)
if [ -z "$missing" ]; then
    install_others "$@"
    exit 0
fi

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
names=
for entry in $missing; do
    names="$names $(apt_name "$entry")"
done
# shellcheck disable=SC2086 # lists of words
if ! run_with_retries $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 install -y --no-install-recommends $names; then
    echo "setup.sh: apt-get could not install:$names" >&2
    echo "setup.sh: see its message above; the package lists need Debian 12 (bookworm)" >&2
    exit 1
fi
install_others "$@"
