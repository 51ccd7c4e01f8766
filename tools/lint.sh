#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Looks at every source file without running anything:
#   sh tools/lint.sh shell              shellcheck on the scripts
#   sh tools/lint.sh format             clang-format on the C++ files
#   sh tools/lint.sh tidy BUILD_DIR [SECONDS]
#                                       clang-tidy on the C++ files but those of tests, which would take as long as
#                                       all others together; BUILD_DIR has compile_commands.json. What changed last
#                                       comes first; with SECONDS no file is begun after them, and how many were
#                                       left out is said
# clang-tidy skips a file that it has passed before in the same words: the preprocessed text, the
# suppressions and the configuration are the key, kept under ${XDG_CACHE_HOME:-~/.cache}/spa-lint.
set -eu
unset CDPATH

tidy_one() {
    build=$1
    cache=$2
    deadline=$3
    file=$4
    if [ "$deadline" -gt 0 ] && [ "$(date +%s)" -ge "$deadline" ]; then
        printf '%s\n' "$file" >>"$cache/left-out"
        return 0
    fi
    entry="[.[] | select(.file == \"$file\")][0]"
    directory=$(jq -r "$entry.directory" "$build/compile_commands.json")
    preprocess=$(jq -r "$entry.command" "$build/compile_commands.json" | sed 's/ -o [^ ]* -c / -E -P /')
    suppressions='find libspa formats samples shaders tests tools -name *.h -exec grep -H NOLINT {} +'
    key=$({
        clang-tidy --version
        cat .clang-tidy "$file"
        set -f
        $suppressions || true
        (cd "$directory" && eval "$preprocess")
    } | sha256sum | cut -d ' ' -f 1)
    [ ! -e "$cache/$key" ] || return 0
    if ! said=$(clang-tidy --quiet -p "$build" "$file" 2>&1); then
        printf '%s\n' "$said"
        return 1
    fi
    : >"$cache/$key"
}

if [ "${1-}" = tidy-one ]; then
    shift
    tidy_one "$@"
    exit
fi

cd -- "$(dirname -- "$0")/.."

cpp_files() {
    find libspa formats samples shaders tests tools \( -name '*.cpp' -o -name '*.h' \) -type f | sort
}

case ${1-} in
shell)
    find tools tests samples .ci -type f \( -name '*.sh' -o -path .ci/run \) | sort | xargs shellcheck
    ;;
format)
    cpp_files | xargs clang-format --dry-run -Werror
    ;;
tidy)
    build=$2
    cache=${XDG_CACHE_HOME:-$HOME/.cache}/spa-lint
    mkdir -p "$cache"
    # What nobody has asked for in a month belongs to code that has changed since.
    find "$cache" -type f -mtime +30 -delete
    deadline=0
    [ $# -lt 3 ] || deadline=$(($(date +%s) + $3))
    rm -f "$cache/left-out"
    files=$(jq -r '.[].file' "$build/compile_commands.json" | grep "^$PWD/" |
        grep -v -e "^$PWD/build/" -e "^$PWD/tests/" | sort -u)
    status=0
    for file in $files; do
        printf '%s %s\n' "$(git log -1 --format=%ct -- "$file")" "$file"
    done | sort -rn -k 1,1 -s | cut -d ' ' -f 2- |
        xargs -n 1 -P "$(nproc)" sh tools/lint.sh tidy-one "$build" "$cache" "$deadline" || status=$?
    if [ -s "$cache/left-out" ]; then
        echo "lint.sh: clang-tidy: out of time; left out: $(wc -l <"$cache/left-out") of" \
            "$(printf '%s\n' "$files" | wc -l) files, those that changed longest ago"
    fi
    exit $status
    ;;
*)
    echo "lint.sh: say one of: shell, format, tidy BUILD_DIR [SECONDS]" >&2
    exit 1
    ;;
esac
