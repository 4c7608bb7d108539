// The OBJ reader and writer.

#include "fuzz/round_trip.h"
#include "fuzz/target.h"

namespace knead::fuzz {

bool run_target(std::span<const std::byte> bytes) {
    return check_round_trip("obj", bytes, {.guesses_columns = true});
}

std::vector<Seed> seeds() {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0.5 1e-3 -2\n";
    return {
        {"points", points},
        {"colours", "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1\n"},
        {"weights", "v 0 0 0 1\nv 1 0 0 2\n"},
        {"weights and colours", "v 0 0 0 1 1 0.5 0\nv 1 0 0 2 0 0 1\n"},
        {"normals", points + "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\n"},
        {"everything", "# made by hand\r\nmtllib a.mtl\r\no thing\r\n" + points +
                           "vt 0 0\nvt 1 0 0\nvn 0 0 1\nvn 0 1 0\nusemtl skin\ng side\ns 1\n"
                           "f 1/1/1 2/2/1 3//2\nf -3 -2 \\\n-1\nl 1 2\np 3\nf 1/2 2/2 3/1"},
        {"lone returns", "v 0 0 0\rv 1 2 3\rf 1 2 1\r"},
        {"bad index", points + "f 1 2 4\n"},
        {"bad number", "v 0 zero 0\n"},
        {"bad nothing", "# nothing\nvn 0 0 1\n"},
    };
}

} // namespace knead::fuzz
