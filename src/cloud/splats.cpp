#include "cloud/splats.h"

#include <algorithm>
#include <string>

namespace knead {

namespace {

constexpr std::size_t most_bands = 3; // of the harmonics that anybody writes
constexpr std::size_t most_harmonics = 3 * most_bands * (most_bands + 2);

std::optional<std::size_t> find_real(const PointCloud& cloud, const std::string& name) {
    const auto column = find_attribute(cloud, name);
    if (!column) return std::nullopt;
    const Attribute& attribute = cloud.attributes[*column];
    const bool real = attribute.type == ScalarType::float32 || attribute.type == ScalarType::float64;
    return real && !attribute.is_list() ? column : std::nullopt;
}

void find_harmonics(const PointCloud& cloud, SplatColumns& splats) {
    std::vector<std::size_t> found;
    // One more than are known tells that they are not; each takes a search through all columns.
    while (found.size() <= most_harmonics) {
        const auto column = find_real(cloud, "f_rest_" + std::to_string(found.size()));
        if (!column) break;
        found.push_back(*column);
    }
    for (std::size_t bands = 1; bands <= most_bands; ++bands)
        if (found.size() == 3 * bands * (bands + 2)) splats.bands = bands;
    const auto named = std::ranges::count_if(
        cloud.attributes, [](const Attribute& attribute) { return attribute.name.starts_with("f_rest_"); });
    const bool all_known = splats.bands > 0 && found.size() == static_cast<std::size_t>(named);
    if (!all_known) splats.bands = 0;
    splats.other_harmonics = named > 0 && !all_known;
    if (all_known) splats.harmonics = std::move(found);
}

} // namespace

std::optional<SplatColumns> find_splats(const PointCloud& cloud) {
    if (!find_real(cloud, "scale_0")) return std::nullopt;
    SplatColumns splats;
    for (std::size_t part = 0; part < 4; ++part) {
        const auto column = find_real(cloud, "rot_" + std::to_string(part));
        if (!column) return std::nullopt;
        splats.rotation[part] = *column;
    }
    find_harmonics(cloud, splats);
    return splats;
}

} // namespace knead
