#!/usr/bin/env bash
# Builds knead and runs its tests, from bare Debian 12 with bash and a clone of this repository.
#
#   ./test.sh                 all tests
#   ./test.sh -R edit         arguments go to ctest
#
# The last line is "N passed, N failed, N skipped"; the exit code is 0 when some test ran and none failed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$root"
report=build/tests.xml

./run.sh --build </dev/null
rm -f "$report"
code=0
ctest --preset release --parallel 2 --output-junit "$root/$report" "$@" </dev/null || code=$?

. tests/count.sh
count_tests "$report"
if [ "$failed" -gt 0 ] || [ $((passed + failed)) = 0 ]; then
    [ "$code" != 0 ] || code=1
fi
printf '%s passed, %s failed, %s skipped\n' "$passed" "$failed" "$skipped"
exit "$code"
