// The LAS reader and writer.

#include "fuzz/round_trip.h"
#include "fuzz/target.h"
#include "io/las.h"
#include "io/las_samples.h"

#include <cmath>
#include <limits>

namespace knead::fuzz {

namespace {

// Of whole numbers times a scale, behind an offset that takes digits off them.
double step_of(const PointCloud& cloud, std::size_t column) {
    const auto& image = dynamic_cast<const LasImage&>(*cloud.image);
    const LasDimension& dimension = image.dimensions[column];
    if (!dimension.scaled) return 0;
    return std::abs(dimension.axis.scale) +
           8 * std::numeric_limits<double>::epsilon() * std::abs(dimension.axis.offset);
}

} // namespace

bool run_target(std::span<const std::byte> bytes) {
    return check_round_trip("las", bytes, {.step = step_of});
}

std::vector<Seed> seeds() {
    std::vector<Seed> result;
    for (const test::LasKind& kind : test::all_las_kinds())
        result.push_back({test::name_of(kind), test::las_sample(kind)});
    test::LasKind kind;
    std::string bytes = test::las_sample(kind);
    result.push_back({"bad cut off", bytes.substr(0, bytes.size() - 1)});
    test::put<std::uint8_t>(bytes, las_at::point_format, 0x80);
    result.push_back({"bad compressed", bytes});
    return result;
}

} // namespace knead::fuzz
