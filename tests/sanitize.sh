#!/usr/bin/env bash
# The tests of the core, without the window, under sanitizers. A find fails the test that it is met in.
#
#   tests/sanitize.sh memory      all rooms, without an OpenCL device: addresses, leaks, undefined behaviour
#   tests/sanitize.sh device      the rooms that use one, with it: addresses, undefined behaviour (the same build)
#   tests/sanitize.sh threads     the rooms of the core that use threads: data races
#   tests/sanitize.sh threads -R edit        what follows goes to ctest
#
# The last line is "sanitizers, WHAT: N passed, N failed, N skipped; built in S s, tested in S s"; the exit code is 0
# when some test ran and none failed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
what=${1:-}
case $what in
memory)
    # The leak checker reads the stacks of all threads; PoCL's run until the process ends, and now and then the checker
    # crashes on one ("Tracer caught signal 11"). So it runs where there is no device.
    preset=core-asan
    rooms='.*'
    targets=(all)
    export ASAN_OPTIONS=detect_leaks=1 OCL_ICD_VENDORS=/nowhere UBSAN_OPTIONS=print_stacktrace=1
    ;;
device)
    preset=core-asan
    rooms='^(upsample|edit|cli): '
    targets=(test_upsample test_edit test_cli knead)
    export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
    ;;
threads)
    preset=core-tsan
    rooms='^(base|graph|deform|upsample|edit): '
    targets=(test_base test_graph test_deform test_upsample test_edit)
    # The threads of PoCL were built without a sanitizer, which takes what they do for races; ours are at work in the
    # reference.
    export OCL_ICD_VENDORS=/nowhere
    export TSAN_OPTIONS=halt_on_error=1
    ;;
*)
    echo "tests/sanitize.sh: what? memory, device or threads" >&2
    exit 2
    ;;
esac
shift
export OPENBLAS_NUM_THREADS=1

begin=$SECONDS
cmake --preset "$preset" -DKNEAD_TESTS=ON >/dev/null
cmake --build --preset "$preset" --target "${targets[@]}"
built=$((SECONDS - begin))

report=build-$preset/tests.xml
rm -f "$report"
code=0
ctest --preset "$preset" --parallel 2 -R "$rooms" --output-junit "$root/$report" "$@" </dev/null || code=$?
. tests/count.sh
count_tests "$report"
printf 'sanitizers, %s: %s passed, %s failed, %s skipped; built in %s s, tested in %s s\n' \
    "$what" "$passed" "$failed" "$skipped" "$built" "$((SECONDS - begin - built))"
[ "$failed" = 0 ] && [ "$passed" -gt 0 ] && exit "$code"
exit $((code > 0 ? code : 1))
