# Writes OUTPUT, a C++ file that defines knead::embedded::VARIABLE as the text of INPUT.
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}" "namespace knead::embedded {\nextern const char* const ${VARIABLE};\n"
    "const char* const ${VARIABLE} = R\"embedded(${text})embedded\";\n}\n")
