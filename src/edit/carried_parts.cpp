#include "edit/carried_parts.h"

#include "deform/rotation.h"
#include "graph/group_tree.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t fewest_contacts = 8;
constexpr std::size_t contact_share = 10; // one in so many
// More would tell no more of a motion: then every so-manieth is taken.
constexpr std::size_t most_contacts = 256;

// A vertex of a part, and what it would lean on.
struct Contact {
    Index part;
    double distance;
    Index vertex, other;
};

std::vector<Contact> all_contacts(std::span<const float> positions, const Components& components,
                                  const std::vector<bool>& held, std::span<const Index> part,
                                  Workers& workers) {
    std::vector<Index> group(components.component.size());
    std::vector<Contact> contacts;
    for (Index v = 0; v < group.size(); ++v) {
        const Index component = components.component[v];
        group[v] = held[component] ? 0 : no_index;
        if (!held[component]) contacts.push_back({part[component], 0, v, no_index});
    }
    const GroupTree tree = group_tree(positions, group, workers);
    workers.for_each(contacts.size(), 256, [&](std::size_t i) {
        const Neighbor near =
            nearest_of_others(tree, contacts[i].vertex, std::numeric_limits<double>::infinity());
        contacts[i].distance = near.distance;
        contacts[i].other = near.vertex;
    });
    std::ranges::sort(contacts, {},
                      [](const Contact& c) { return std::tuple(c.part, c.distance, c.vertex); });
    return contacts;
}

// How many of a part's contacts count.
std::size_t contacts_that_count(std::size_t vertices) {
    return std::min(vertices, std::max(fewest_contacts, vertices / contact_share));
}

} // namespace

Contacts find_contacts(std::span<const float> positions, const Components& components,
                       const std::vector<bool>& held, Workers& workers) {
    Contacts result;
    result.part.assign(components.size.size(), no_index);
    result.first.push_back(0);
    if (std::ranges::find(held, true) == held.end()) return result;
    Index parts = 0;
    for (std::size_t c = 0; c < held.size(); ++c)
        if (!held[c]) result.part[c] = parts++;
    if (parts == 0) return result;
    const std::vector<Contact> contacts = all_contacts(positions, components, held, result.part, workers);
    for (auto begin = contacts.begin(); begin != contacts.end();) {
        const auto end = std::find_if(begin, contacts.end(),
                                      [&](const Contact& other) { return other.part != begin->part; });
        const std::size_t count = contacts_that_count(static_cast<std::size_t>(end - begin));
        const std::size_t step = (count + most_contacts - 1) / most_contacts;
        for (std::size_t i = 0; i < count; i += step)
            result.vertex.push_back((begin + static_cast<std::ptrdiff_t>(i))->other);
        result.first.push_back(static_cast<Index>(result.vertex.size()));
        begin = end;
    }
    return result;
}

CarriedParts carried_parts(const Contacts& contacts, const InfluenceRows& rows, InfluenceWeights weights,
                           std::span<const Index> mover) {
    CarriedParts result;
    result.first.push_back(0);
    std::vector<std::pair<Index, double>> shares;
    for (std::size_t p = 0; p < contacts.parts(); ++p) {
        shares.clear();
        double sum = 0;
        for (Index at = contacts.first[p]; at < contacts.first[p + 1]; ++at) {
            const Influence influence = influence_of(rows, weights, mover[contacts.vertex[at]]);
            for (std::size_t k = 0; k < influence.count; ++k) {
                const auto weight = static_cast<double>(influence.weight[k]);
                if (weight > 0) shares.emplace_back(influence.motion[k], weight);
                sum += weight;
            }
        }
        std::ranges::stable_sort(shares, {}, &std::pair<Index, double>::first);
        for (auto share = shares.begin(); share != shares.end();) {
            const Index motion = share->first;
            double weight = 0;
            for (; share != shares.end() && share->first == motion; ++share) weight += share->second;
            result.motion.push_back(motion);
            result.weight.push_back(weight / sum);
        }
        result.first.push_back(static_cast<Index>(result.motion.size()));
    }
    result.anchor.assign(contacts.parts(), Vec3d::Zero());
    return result;
}

Motion carried_motion(const CarriedParts& parts, std::size_t part, std::span<const Motion> motions) {
    Eigen::Matrix<double, 3, 4> mean = Eigen::Matrix<double, 3, 4>::Zero();
    for (Index at = parts.first[part]; at < parts.first[part + 1]; ++at) {
        using Map = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;
        mean += parts.weight[at] * Eigen::Map<const Map>(motions[parts.motion[at]].map).cast<double>();
    }
    const Mat3d map = mean.leftCols<3>();
    const Vec3d& anchor = parts.anchor[part];
    const Mat3d turn = turn_of(nearest_rotation(Mat3d::Identity() + map, Quatd::Identity()));
    const Vec3d offset = mean.col(3) + (map - turn) * anchor;
    Motion result;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) result.map[4 * i + j] = static_cast<float>(turn(i, j));
        result.map[4 * i + 3] = static_cast<float>(offset[i]);
    }
    return result;
}

} // namespace knead
