// The PCD reader and writer.

#include "fuzz/round_trip.h"
#include "fuzz/target.h"

#include <array>
#include <cstdint>

namespace knead::fuzz {

namespace {

template<typename T>
std::string bytes_of(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

// Three points of x y z as floats, a colour, and two 2-byte numbers.
std::string header(const std::string& data) {
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb pair\nSIZE 4 4 4 4 2\n"
           "TYPE F F F U I\nCOUNT 1 1 1 1 2\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA " +
           data + "\n";
}

std::string point(std::size_t i) {
    const auto number = static_cast<std::int16_t>(i);
    std::string bytes;
    for (const float coordinate : {1.5F, 2.5F, 3.5F}) bytes += bytes_of(coordinate * static_cast<float>(i));
    return bytes + bytes_of(std::uint32_t{0xFF8040}) + bytes_of(number) + bytes_of(number);
}

// The same, field by field, in an LZF stream of nothing but literal runs of up to 32 bytes.
std::string compressed() {
    std::string body;
    constexpr std::array<std::size_t, 6> begins{0, 4, 8, 12, 16, 20};
    for (std::size_t field = 0; field + 1 < begins.size(); ++field)
        for (std::size_t i = 0; i < 3; ++i)
            body += point(i).substr(begins[field], begins[field + 1] - begins[field]);
    std::string stream;
    for (std::size_t at = 0; at < body.size(); at += 32) {
        const std::string run = body.substr(at, 32);
        stream += static_cast<char>(run.size() - 1) + run;
    }
    return bytes_of(static_cast<std::uint32_t>(stream.size())) +
           bytes_of(static_cast<std::uint32_t>(body.size())) + stream;
}

} // namespace

bool run_target(std::span<const std::byte> bytes) {
    return check_round_trip("pcd", bytes);
}

std::vector<Seed> seeds() {
    const std::string organised =
        "VERSION .7\nFIELDS x y z normal_x normal_y normal_z _\nSIZE 4 4 4 4 4 4 1\n"
        "TYPE F F F F F F U\nCOUNT 1 1 1 1 1 1 4\nWIDTH 2\nHEIGHT 2\nDATA ascii\n";
    return {
        {"ascii", header("ascii") + "0 0 0 0 1 2\n1.5 nan 3 16744512 3 4\n-1e9 0.25 3 1 5 6\n"},
        {"binary", header("binary") + point(0) + point(1) + point(2)},
        {"binary, bytes behind", header("binary") + point(0) + point(1) + point(2) + "more"},
        {"binary_compressed", header("binary_compressed") + compressed()},
        {"organised", organised + "0 0 0 0 0 1 1 2 3 4\nnan nan nan 0 0 1 1 2 3 4\n1 0 0 0 0 1 1 2 3 4\n"
                                  "1 1 0 0 0 1 1 2 3 4\n"},
        {"short header", "FIELDS x y z\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6"},
        {"bad count", header("binary") + point(0)},
        {"bad stream", header("binary_compressed") + compressed().substr(0, 40)},
    };
}

} // namespace knead::fuzz
