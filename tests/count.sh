# For scripts that ran ctest: counts what its report says.

# count_tests REPORT: sets `passed`, `failed` and `skipped`.
count_tests() {
    local not_run skipped_itself
    # A test "notrun" was skipped by its own word, or could not be started, which is a failure.
    passed=$(count_lines "$1" 'testcase .* status="run"')
    not_run=$(count_lines "$1" 'testcase .* status="notrun"')
    skipped_itself=$(count_lines "$1" 'skipped message="SKIP_')
    skipped=$((skipped_itself + $(count_lines "$1" 'testcase .* status="disabled"')))
    failed=$((not_run - skipped_itself + $(count_lines "$1" 'testcase .* status="fail"')))
}

# How many lines of the report match.
count_lines() { { cat "$1" 2>/dev/null || true; } | grep -cE "^[[:space:]]*<$2" || true; }
