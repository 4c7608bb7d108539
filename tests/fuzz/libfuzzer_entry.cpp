// libFuzzer's way into a target.

#include "fuzz/target.h"

#include <cstdint>

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    knead::fuzz::run_target(std::as_bytes(std::span(data, size)));
    return 0;
}
