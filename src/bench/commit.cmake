# Writes OUTPUT, a C++ file that defines knead::build_commit as the commit of the checkout SOURCE: run at every build, it
# touches the file only when the commit changed.
set(commit "unknown")
find_program(git git)
if(git)
    execute_process(COMMAND "${git}" --no-optional-locks describe --always --dirty --abbrev=12 --exclude=*
        WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE told RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed AND told MATCHES "^[0-9a-f]+(-dirty)?$")
        set(commit "${told}")
    endif()
endif()
set(text "namespace knead {\nextern const char* const build_commit;\nconst char* const build_commit = \"${commit}\";\n}\n")
set(before "")
if(EXISTS "${OUTPUT}")
    file(READ "${OUTPUT}" before)
endif()
if(NOT text STREQUAL before)
    file(WRITE "${OUTPUT}" "${text}")
endif()
