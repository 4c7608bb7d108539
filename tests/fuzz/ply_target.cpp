// The PLY reader, its header, and the writer.

#include "fuzz/round_trip.h"
#include "fuzz/target.h"
#include "io/ply_samples.h"
#include "shapes/shapes.h"

namespace knead::fuzz {

namespace {

std::string made_by_knead(Shape shape) {
    Workers workers(1);
    SilentProgress progress;
    ShapeOptions options;
    options.points = 8;
    return test::written(make_shape(shape, options, workers, progress), {});
}

// Three points, in the words of one who writes by hand.
std::string text_file(const std::string& columns, const std::string& rows) {
    return "ply\nformat ascii 1.0\nelement vertex 3\n" + columns + "end_header\n" + rows;
}

} // namespace

bool run_target(std::span<const std::byte> bytes) {
    return check_round_trip("ply", bytes);
}

std::vector<Seed> seeds() {
    std::vector<Seed> result;
    for (const test::SampleKind& kind : test::all_sample_kinds())
        result.push_back({"sample " + test::name_of(kind), test::sample(kind)});
    result.push_back({"plane", made_by_knead(Shape::plane)});
    result.push_back({"solid-bar", made_by_knead(Shape::solid_bar)});
    const std::string xyz = "property float x\nproperty double y\nproperty int z\n";
    result.push_back({"odd numbers", text_file(xyz, "+1 1e400 2.0\n nan -inf -3\n\n1.#INF 1.#IND 4\n")});
    result.push_back({"list left out",
                      text_file(xyz + "property list uchar float seen\n", "0 1 2\n3 4 5 1 6\n7 8 9 0\n")});
    result.push_back({"no end of line", text_file(xyz, "1 2 3\r\n4 5 6\r\n7 8 9")});
    result.push_back({"bytes behind", text_file(xyz, "1 2 3\n4 5 6\n7 8 9\n\nand more")});
    result.push_back(
        {"no points", "ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + xyz + "end_header\n"});
    result.push_back({"bad count", text_file(xyz, "1 2 3\n")});
    result.push_back(
        {"bad list", text_file(xyz + "property list int int seen\n", "1 2 3 9223372036854775807\n")});
    result.push_back({"bad header", "ply\nformat ascii 1.0\n"});
    return result;
}

} // namespace knead::fuzz
