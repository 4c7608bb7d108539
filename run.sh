#!/usr/bin/env bash
# Builds knead and shows what it does. From bare Debian 12 with bash and a clone of this repository:
#
#   ./run.sh            replays the demonstration session, and opens it in the editor
#   ./run.sh SESSION    opens a recorded session in the editor
#   ./run.sh FILE       opens a point cloud in the editor
#   ./run.sh --build    only builds, and the tests too (test.sh does so)
#
# Without a display a session is replayed (the bent cloud goes to build/replayed/), and a cloud is described.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
demonstration="$root/data/creature-wave.knead"

say() { printf '%s\n' "$*" >&2; }

# Shows the end of a log and gives up.
fail_with_log() {
    tail -n 40 "$2" >&2
    say "$1 failed; the lines above are the end of $2"
    exit 1
}

# Shows ninja's "[12/80] Building …" lines as one line that counts, and only when something is compiled.
show_progress() {
    local line announced=
    while IFS= read -r line; do
        if [[ ! $line =~ ^\[([0-9]+)/([0-9]+)\]\ (Building|Linking) ]]; then continue; fi
        if [ -z "$announced" ]; then
            announced=yes
            say "Building knead (a few minutes the first time) ..."
        fi
        if [ -t 2 ]; then printf '\r\033[K  %s of %s' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&2; fi
    done
    if [ -n "$announced" ] && [ -t 2 ]; then printf '\r\033[K' >&2; fi
}

# Builds the program alone, or with `all` the tests too, which take as long again.
build() {
    "$root/third_party/install.sh"
    cd "$root"
    mkdir -p build
    # Ninja configures again by itself when that is needed.
    if [ ! -e build/build.ninja ]; then
        cmake --preset release >build/configure.log 2>&1 || {
            rm -f build/build.ninja # so that the next run does not take this for configured
            fail_with_log "Configuring" build/configure.log
        }
    fi
    cmake --build --preset release --target "$1" 2>&1 | tee build/build.log | show_progress ||
        fail_with_log "Building" build/build.log
}

# Whether a file is a session, whatever its name: an object whose first kilobyte has the key "knead".
is_session() {
    local beginning
    beginning=$(head -c 1024 -- "$1" | LC_ALL=C tr -d ' \t\r\n\0\357\273\277')
    [[ $beginning == '{'*'"knead":'* ]]
}

replay() {
    local session=$1 name result code=0
    name=$(basename -- "$session")
    result="$root/build/replayed/${name%.*}.ply"
    mkdir -p "$root/build/replayed"
    "$root/build/knead" replay "$session" --out "$result" || code=$?
    if [ "$code" = 0 ] || [ "$code" = 4 ]; then say "The bent cloud is in $result"; fi
    return "$code"
}

has_display() { [ -n "${DISPLAY:-}" ]; }

# The editor; or, where it cannot open its window, the same without one. It says itself why it cannot.
edit() {
    local code=0
    "$root/build/knead" edit "$1" || code=$?
    if [ "$code" != 2 ]; then exit "$code"; fi
}

without_window() {
    if is_session "$1"; then
        replay "$1"
    else
        "$root/build/knead" info "$1"
        say "There is no display for the editor window. To bend this cloud without one, write its handles into a" \
            "session (man -l $root/data/knead.1) and run ./run.sh SESSION"
    fi
}

main() {
    if [ $# -gt 1 ]; then
        say "usage: ./run.sh [FILE|SESSION]"
        return 2
    fi
    local file
    case "${1:-}" in
        -h | --help)
            sed -n '2,/^set /{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
            return 0
            ;;
        --build)
            build all
            return 0
            ;;
        -*)
            say "usage: ./run.sh [FILE|SESSION]"
            return 2
            ;;
        '') file=$demonstration ;;
        *) file=$1 ;;
    esac
    if [ ! -f "$file" ] || [ ! -r "$file" ]; then
        say "$file: there is no such file, or it cannot be read"
        return 3
    fi

    (build knead)
    if [ $# = 0 ]; then
        say "The demonstration: replaying ${file#"$root/"}"
        replay "$file"
        if has_display; then edit "$file"; fi
        return
    fi
    if has_display; then edit "$file"; fi
    without_window "$file"
}

main "$@"
