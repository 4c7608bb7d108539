#pragma once
// Functions for the processors of the last ten years, in a program that runs on older ones too.

// Before a function: it is compiled twice where the compiler can, the second time for such processors, and
// which one is called is chosen when the program starts. Both round alike. What is to be compiled so must be
// inlined into it. The choice is made by the loader of glibc (indirect functions).
#include <cstddef> // tells whether it is glibc

#if defined(__GLIBC__) && defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                 \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define KNEAD_FOR_NEW_PROCESSORS_TOO __attribute__((target_clones("avx2", "default")))
#else
#define KNEAD_FOR_NEW_PROCESSORS_TOO
#endif
