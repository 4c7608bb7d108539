#include "cloud/cloud_part.h"

#include "base/require.h"

namespace knead {

namespace {

// Calls `keep` with where each run of points that stay begins and ends.
template<typename Keep>
void for_runs(std::span<const std::uint8_t> left_out, const Keep& keep) {
    for (std::size_t begin = 0; begin < left_out.size();) {
        std::size_t end = begin;
        while (end < left_out.size() && left_out[end] == left_out[begin]) ++end;
        if (left_out[begin] == 0) keep(begin, end);
        begin = end;
    }
}

Attribute part_of(const Attribute& attribute, std::span<const std::uint8_t> left_out) {
    Attribute part{attribute.name, attribute.type, {}, {}, attribute.count_type};
    const std::size_t size = size_of(attribute.type);
    const auto keep_values = [&](std::uint64_t begin, std::uint64_t end) {
        const std::byte* const values = attribute.values.data();
        part.values.insert(part.values.end(), values + begin * size, values + end * size);
    };
    if (!attribute.is_list()) {
        for_runs(left_out, keep_values);
        return part;
    }
    part.first.push_back(0);
    for_runs(left_out, [&](std::size_t begin, std::size_t end) {
        keep_values(attribute.first[begin], attribute.first[end]);
        for (std::size_t i = begin; i < end; ++i)
            part.first.push_back(part.first.back() + attribute.first[i + 1] - attribute.first[i]);
    });
    return part;
}

} // namespace

PointCloud part_of(const PointCloud& cloud, std::span<const std::uint8_t> left_out) {
    require(left_out.size() == cloud.size(), "it is said of each point whether it stays");
    PointCloud part;
    part.positions = part_of(cloud.positions, 3, left_out);
    part.origin = cloud.origin;
    part.attributes.reserve(cloud.attributes.size());
    for (const Attribute& attribute : cloud.attributes)
        part.attributes.push_back(part_of(attribute, left_out));
    part.coordinate_columns = cloud.coordinate_columns;
    return part;
}

std::vector<float> part_of(std::span<const float> values, std::size_t each,
                           std::span<const std::uint8_t> left_out) {
    std::vector<float> part;
    if (values.empty()) return part;
    require(values.size() == each * left_out.size(), "as many values as points");
    for_runs(left_out, [&](std::size_t begin, std::size_t end) {
        part.insert(part.end(), values.data() + each * begin, values.data() + each * end);
    });
    return part;
}

} // namespace knead
