// The OFF reader and writer.

#include "fuzz/round_trip.h"
#include "fuzz/target.h"

namespace knead::fuzz {

bool run_target(std::span<const std::byte> bytes) {
    return check_round_trip("off", bytes, {.guesses_columns = true});
}

std::vector<Seed> seeds() {
    return {
        {"points", "OFF\n2 0 0\n0 0 0\n1 2 3\n"},
        {"faces", "OFF # made by hand\r\n3 1 3\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2 255 0 0\r\n"},
        {"one line", "OFF 3 1 0\n\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2"},
        {"normals", "NOFF\n2 0 0\n0 0 0 0 0 1\n1 2 3 0 1 0\n"},
        {"colours", "COFF\n2 0 0\n0 0 0 255 0 10 255\n1 2 3 0 0 1 0\n"},
        {"real colours", "COFF\n2 0 0\n0 0 0 1 0.5 0\n1 2 3 0 0 1\n"},
        {"everything", "STCNOFF\n1 0 0\n0 0 0 0 0 1 255 0 10 255 0.5 0.25 9\n"},
        {"no keyword", "2 0 0\n0 0 0\n1 2 3\n"},
        {"bad keyword", "OF\n2 0 0\n0 0 0\n1 2 3\n"},
        {"bad count", "OFF\n3 0 0\n0 0 0\n"},
        {"bad face", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n"},
        {"bad binary", "OFF BINARY\n"},
    };
}

} // namespace knead::fuzz
