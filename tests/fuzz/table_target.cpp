// The reader and the writers of tables of numbers: .xyz, .txt, .csv and .pts.

#include "fuzz/round_trip.h"
#include "fuzz/target.h"

#include <array>

namespace knead::fuzz {

namespace {

constexpr std::array<const char*, 4> kinds{"txt", "xyz", "csv", "pts"};

} // namespace

// The kind goes by the file's name, and so here by something that the fuzzer can choose.
bool run_target(std::span<const std::byte> bytes) {
    return check_round_trip(kinds.at(bytes.size() % kinds.size()), bytes, {.guesses_columns = true});
}

std::vector<Seed> seeds() {
    const std::vector<Seed> tables{
        {"plain", "0 0 0\n1 0 0\n0.5 1e-3 -2\n"},
        {"tabs", "1\t2\t3\t4\r\n5\t6\t7\t8\r\n"},
        {"lone returns", "1 2 3\r4 5 6\r"},
        {"named", "x,y,z,nx,ny,nz,quality\n1,2,3,0,0,1,7\n4,5,6,0,1,0,8\n"},
        {"quoted names", "\"X\";\"Y\";\"Z\";\"R\";\"G\";\"B\"\n1,5;2,5;3;255;0;10\n4;5;6;1;2;3\n"},
        {"decimal commas", "x\ty\tz\tq\n1,5\t2,5\t3\t7,25\n4\t5\t6\t0\n"},
        {"remark with names", "# x y z intensity\n1 2 3 0.5\n4 5 6 0.25\n"},
        {"byte-order mark", "\xEF\xBB\xBF// made by hand\n\n1 2 3\n4 5 6\n"},
        {"count", "2\n1 2 3 -100 255 0 1\n4 5 6 20 0 0 0\n"},
        {"not finite", "1 2 3\nnan inf -inf\n4 5 6\n"},
        {"no end of line", "1 2 3 255 0 0\n4 5 6 0 255 0"},
    };
    std::vector<Seed> result;
    for (const Seed& table : tables) // empty lines change the kind
        for (std::size_t more = 0; more < kinds.size(); ++more)
            result.push_back(
                {table.name + " " + std::to_string(more), table.bytes + std::string(more, '\n')});
    result.push_back({"bad row", "1 2 3\n4 5\n"});
    result.push_back({"bad word", "1 2 3\n4 five 6\n"});
    return result;
}

} // namespace knead::fuzz
