#!/usr/bin/env bash
# Fuzzes the readers and the session parser under sanitizers:
#
#   tests/fuzz/run.sh [SECONDS] [TARGET]...     SECONDS for each (60); all targets where none is named
#
# Needs clang with libFuzzer (Debian: clang libclang-rt-14-dev). Builds into build-fuzz, where the corpus and the
# finds stay: build-fuzz/corpus/TARGET, build-fuzz/finds/TARGET. One process at a time, in slices of at most 100
# seconds; $FUZZ_PREFIX is put before each ("nice -n 19" if it is not set). Prints a table, and exits with 1 if
# there was a find. To look into one:
#
#   build-fuzz/tests/fuzz/fuzz_TARGET build-fuzz/finds/TARGET/crash-…
#   build-fuzz/tests/fuzz/fuzz_TARGET -minimize_crash=1 -max_total_time=30 build-fuzz/finds/TARGET/crash-…
#
# What was mended goes into tests/fuzz/finds/TARGET, which every build's tests replay.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
slice=100
most_finds=10 # of a target in one run; a shallow one would be found over and over

say() { printf '%s\n' "$*" >&2; }

seconds=60
if [[ ${1:-} =~ ^[0-9]+$ ]]; then
    seconds=$1
    shift
fi
targets=("$@")
if [ ${#targets[@]} = 0 ]; then
    for file in "$here"/*_target.cpp; do
        name=${file##*/}
        targets+=("${name%_target.cpp}")
    done
fi
for target in "${targets[@]}"; do
    [ -e "$here/${target}_target.cpp" ] || { say "there is no target $target in $here"; exit 2; }
done
read -r -a prefix <<<"${FUZZ_PREFIX-nice -n 19}"

cd "$root"
[ -e build-fuzz/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build build-fuzz --target "${targets[@]/#/fuzz_}" "${targets[@]/#/replay_}" >&2

# Scratch files in memory, and gone in the end, whatever a crash leaves.
TMPDIR=$(mktemp -d "$([ -d /dev/shm ] && echo /dev/shm || echo /tmp)/knead-fuzz.XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# The last value of a statistic in a log, or 0.
statistic() { sed -n "s/^stat::$2: *//p" "$1" | tail -n 1 | grep . || echo 0; }

# Fuzzes one target for a while; leaves executions, seconds, coverage and finds in the variables of these names.
fuzz() {
    local target=$1 corpus=build-fuzz/corpus/$1 artifacts=build-fuzz/finds/$1 log=build-fuzz/fuzz-$1.log
    local begin before now length dictionary=$here/dictionaries/$1.dict
    mkdir -p "$corpus" "$artifacts"
    "build-fuzz/tests/fuzz/replay_$target" --write-seeds "$corpus"
    executions=0 fuzzed=0 coverage=0
    before=$(find "$artifacts" -type f | wc -l)
    finds=0
    while [ "$fuzzed" -lt "$seconds" ] && [ "$finds" -lt "$most_finds" ]; do
        length=$((seconds - fuzzed < slice ? seconds - fuzzed : slice))
        begin=$SECONDS
        "${prefix[@]}" "build-fuzz/tests/fuzz/fuzz_$target" "$corpus" -max_total_time="$length" -max_len=4096 \
            -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=64 -print_final_stats=1 -reload=0 \
            -artifact_prefix="$artifacts/" $([ -e "$dictionary" ] && echo "-dict=$dictionary") >"$log" 2>&1 || true
        now=$((SECONDS - begin))
        fuzzed=$((fuzzed + (now > 0 ? now : 1)))
        executions=$((executions + $(statistic "$log" number_of_executed_units)))
        coverage=$(grep -oE ' cov: [0-9]+' "$log" | tail -n 1 | grep -oE '[0-9]+' || echo 0)
        finds=$(($(find "$artifacts" -type f | wc -l) - before))
        say "$target: $executions executions in $fuzzed s, coverage $coverage, $finds finds"
    done
}

table=$(printf '%-12s %12s %8s %10s %9s %6s' target executions seconds "per second" coverage finds)
all_finds=0
for target in "${targets[@]}"; do
    fuzz "$target"
    table+=$(printf '\n%-12s %12s %8s %10s %9s %6s' "$target" "$executions" "$fuzzed" $((executions / fuzzed)) \
        "$coverage" "$finds")
    all_finds=$((all_finds + finds))
done
printf '%s\n' "$table"
[ "$all_finds" = 0 ]
