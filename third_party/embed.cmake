# Writes OUTPUT, a C++ file that defines knead::embedded::VARIABLE as the text of INPUT; with BYTES=ON as a
# std::span of its bytes.
if(BYTES)
    file(READ "${INPUT}" hexadecimal HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${hexadecimal}")
    file(WRITE "${OUTPUT}" "#include <span>\n\nnamespace knead::embedded {\n"
        "namespace {\nconstexpr unsigned char bytes[] = {${bytes}};\n}\n"
        "extern const std::span<const unsigned char> ${VARIABLE};\n"
        "const std::span<const unsigned char> ${VARIABLE}(bytes);\n}\n")
    return()
endif()
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}" "namespace knead::embedded {\nextern const char* const ${VARIABLE};\n"
    "const char* const ${VARIABLE} = R\"embedded(${text})embedded\";\n}\n")
