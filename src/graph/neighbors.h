#pragma once
// The neighbourhood graph of the points, and what hangs together in it.

#include "base/progress.h"
#include "base/workers.h"
#include "graph/csr.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace knead {

// Links every vertex to its k nearest others (all others, if there are fewer), exactly, by FLANN, and back.
// `positions`: 3 floats a vertex, finite and pairwise different. k ≥ 1. Throws Error (input) for more links
// than an Index can number.
Graph neighbor_graph(std::span<const float> positions, std::size_t k, Workers& workers, Progress& progress);

// A component for each vertex. Where there is one alone, nothing is stored.
class ComponentNumbers {
public:
    ComponentNumbers() = default;
    // `component`: of each vertex, below `components`.
    ComponentNumbers(std::vector<Index> component, std::size_t components) : size_(component.size()) {
        if (components > 1) numbers_ = std::move(component);
    }

    std::size_t size() const { return size_; }
    Index operator[](std::size_t v) const { return numbers_.empty() ? 0 : numbers_[v]; }
    std::vector<Index> of_all() const { return numbers_.empty() ? std::vector<Index>(size_, 0) : numbers_; }
    bool operator==(const ComponentNumbers&) const = default;

private:
    std::vector<Index> numbers_;
    std::size_t size_ = 0;
};

// Which vertices hang together: component[v] numbers them by their lowest vertex, from 0.
struct Components {
    ComponentNumbers component;
    std::vector<Index> size; // vertices in each
};
Components find_components(const Graph& graph, Workers& workers);

// The same of those links alone whose entry in `stays` is not 0: one for every entry of graph.neighbor, the
// same for both directions of a link.
Components find_components(const Graph& graph, std::span<const std::uint8_t> stays, Workers& workers);

} // namespace knead
