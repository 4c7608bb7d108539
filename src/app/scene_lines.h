#pragma once
// What is drawn over the cloud in lines: the ground, and what the solver works on.

#include "app/display.h"
#include "app/falloff_halo.h"
#include "edit/editor.h"

#include <optional>
#include <vector>

namespace knead {

// What the lines are made of, to tell whether they have to be made again.
struct SceneLinesOf {
    bool grid = false, samples = false, links = false;
    UpAxis up = UpAxis::z;
    std::optional<int> mirror_axis; // of the plane across which moves are mirrored
    double mirror_at = 0;
    std::shared_ptr<const std::vector<Index>> sample_vertices;
    std::shared_ptr<const Graph> sample_graph;
    std::shared_ptr<const std::vector<HaloDot>> halo;
    std::uint32_t halo_color = 0; // its bytes r, g, b
    std::uint64_t version = 0;    // of the frame, where the lines follow it

    bool operator==(const SceneLinesOf&) const = default;
};
// `halo`: null where none is to be seen.
SceneLinesOf scene_lines_of(const Editor& editor, const Display& display,
                            std::shared_ptr<const std::vector<HaloDot>> halo, std::uint32_t halo_color);

std::vector<OverlayLine> scene_lines(const Editor& editor, const SceneLinesOf& what);

// More samples than this are not shown: they would cover the cloud, and take long to draw.
inline constexpr std::size_t most_shown_samples = 20000;

} // namespace knead
