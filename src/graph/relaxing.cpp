#include "graph/relaxing.h"

#include "graph/flood.h"

#include <limits>

namespace knead {

namespace {

constexpr std::size_t vertices_a_part = 1 << 14;

// What a part of the vertices, a range of them, adds to a territory.
struct Share {
    Index sample;
    double count = 0;
    Vec3d sum = Vec3d::Zero();
};

// The vertex of a territory that a part of the vertices proposes for its sample.
struct Candidate {
    Index sample, vertex;
    double squared; // its distance from the middle
};

// One item for each territory that a part meets, made by make(sample) and brought up to date by
// meet(item, vertex) with every vertex of the part that belongs to it. Parts are ranges of vertices, of
// neighbours along the curve, so that each meets few territories, and their items are the same whoever makes
// them.
template<typename Item, typename Make, typename Meet>
std::vector<std::vector<Item>> by_parts(std::span<const Index> territory, std::size_t samples,
                                        Workers& workers, Make&& make, Meet&& meet) {
    std::vector<std::vector<Item>> parts((territory.size() + vertices_a_part - 1) / vertices_a_part);
    workers.for_chunks(territory.size(), vertices_a_part, [&](std::size_t begin, std::size_t end) {
        std::vector<Item>& items = parts[begin / vertices_a_part];
        std::vector<Index> place(samples, no_index); // of each sample's item
        for (auto v = static_cast<Index>(begin); v < end; ++v) {
            const Index sample = territory[v];
            if (sample == no_index) continue;
            if (place[sample] == no_index) {
                place[sample] = static_cast<Index>(items.size());
                items.push_back(make(sample));
            }
            meet(items[place[sample]], v);
        }
    });
    return parts;
}

// The mean position of each territory.
std::vector<Vec3d> middles(std::span<const Index> territory, std::size_t samples,
                           std::span<const float> positions, Workers& workers) {
    const auto parts = by_parts<Share>(
        territory, samples, workers, [](Index sample) { return Share{sample}; },
        [&](Share& share, Index v) {
            share.sum += point_at(positions, v);
            share.count += 1;
        });
    std::vector<Vec3d> middle(samples, Vec3d::Zero());
    std::vector<double> count(samples, 0);
    for (const auto& part : parts)
        for (const Share& share : part) {
            middle[share.sample] += share.sum;
            count[share.sample] += share.count;
        }
    for (std::size_t s = 0; s < samples; ++s) middle[s] /= count[s]; // a sample's own vertex belongs to it
    return middle;
}

// Moves each sample to the vertex of its territory that is nearest to the middle, the first of equals.
void move_to_middles(std::span<const Index> territory, std::span<const float> positions,
                     std::vector<Index>& samples, Workers& workers) {
    const std::vector<Vec3d> middle = middles(territory, samples.size(), positions, workers);
    constexpr double far = std::numeric_limits<double>::infinity();
    const auto parts = by_parts<Candidate>(
        territory, samples.size(), workers,
        [](Index sample) {
            return Candidate{sample, no_index, far};
        },
        [&](Candidate& best, Index v) {
            const double squared = (point_at(positions, v) - middle[best.sample]).squaredNorm();
            if (squared < best.squared) best.vertex = v, best.squared = squared;
        });
    std::vector<double> smallest(samples.size(), far);
    for (const auto& part : parts)
        for (const Candidate& best : part) {
            if (best.squared >= smallest[best.sample]) continue;
            smallest[best.sample] = best.squared;
            samples[best.sample] = best.vertex;
        }
}

} // namespace

std::vector<Index> relaxed(std::vector<Index> samples, const Graph& graph,
                           std::span<const std::uint8_t> lengths, std::span<const float> positions,
                           std::span<const std::uint8_t> barred, int rounds, Workers& workers,
                           Progress& progress) {
    for (int round = 0; round < rounds; ++round) {
        std::vector<Index> territory = territories(graph, lengths, samples, workers, progress);
        for (std::size_t v = 0; v < barred.size(); ++v)
            if (barred[v]) territory[v] = no_index;
        move_to_middles(territory, positions, samples, workers);
    }
    return samples;
}

} // namespace knead
