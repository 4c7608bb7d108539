#include "render/software_lines.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

// Cuts the end `a` off where the line comes out of the near plane.
glm::vec4 before_eye(const glm::vec4& a, const glm::vec4& b) {
    const float da = a.z + a.w, db = b.z + b.w;
    return da < 0 && db > 0 ? glm::mix(a, b, da / (da - db)) : a;
}

std::uint32_t blended(std::uint32_t below, std::uint32_t rgba, float cover) {
    const float alpha = static_cast<float>(rgba >> 24) / 255 * cover;
    const auto part = [&](unsigned to, unsigned from) {
        const float under = static_cast<float>(below >> to & 0xff);
        const float over = static_cast<float>(rgba >> from & 0xff);
        return static_cast<std::uint32_t>(under + alpha * (over - under) + 0.5f) << to;
    };
    return part(16, 0) | part(8, 8) | part(0, 16) | 0xff000000U;
}

// One line within some rows.
struct Pen {
    const FlatLine& line;
    glm::vec2 from, along; // pixels; `along` of length 1
    float length, reach;

    explicit Pen(const FlatLine& line_)
        : line(line_), from(line_.from), along(glm::vec2(line_.to) - from), length(glm::length(along)),
          reach(line_.half_width + 1) {
        along = length > 1e-4f ? along / length : glm::vec2(1, 0);
    }

    void touch(int x, int y, const Pixels& pixels, std::uint32_t* picture) const {
        const glm::vec2 here = glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) - from;
        const float way = glm::dot(here, along);
        const float distance = glm::distance(here, std::clamp(way, 0.0f, length) * along);
        const float cover = std::min(line.half_width + 0.5f - distance, 1.0f);
        if (cover <= 0) return;
        const float part = std::clamp((way + reach) / (length + 2 * reach), 0.0f, 1.0f);
        const std::size_t at = static_cast<std::size_t>(y) * pixels.row() + static_cast<std::size_t>(x);
        if (line.from.z + part * (line.to.z - line.from.z) > pixels.depths[at]) return;
        picture[at] = blended(picture[at], line.rgba, cover);
    }

    void draw(int first, int end, const Pixels& pixels, std::uint32_t* picture) const {
        const float low = std::min(line.from.y, line.to.y) - reach;
        const float high = std::max(line.from.y, line.to.y) + reach;
        // What is no number is far to the left.
        const auto whole = [](float v) {
            return v > -1e6f ? static_cast<int>(std::min(v, 1e6f)) : -1'000'000;
        };
        const float steepness = along.x / (std::abs(along.y) > 1e-6f ? along.y : 1e-6f);
        for (int y = std::max(first, whole(low)); y < std::min(end, whole(high) + 1); ++y) {
            // Where the line is while it passes this row, and as far to either side as it is wide.
            const float a = from.x + steepness * (static_cast<float>(y) - reach - from.y);
            const float b = from.x + steepness * (static_cast<float>(y) + 1 + reach - from.y);
            const float left = std::max(std::min(a, b), std::min(line.from.x, line.to.x)) - reach;
            const float right = std::min(std::max(a, b), std::max(line.from.x, line.to.x)) + reach;
            for (int x = std::max(0, whole(left)); x < std::min(pixels.width, whole(right) + 1); ++x)
                touch(x, y, pixels, picture);
        }
    }
};

} // namespace

std::vector<FlatLine> flat_lines(std::span<const OverlayLine> lines, const LineView& view,
                                 Viewport viewport) {
    std::vector<FlatLine> flat;
    const glm::vec2 screen(viewport.width, viewport.height);
    const auto place = [&](const glm::vec4& p) {
        return glm::vec3((0.5f + 0.5f * p.x / p.w) * screen.x, (0.5f - 0.5f * p.y / p.w) * screen.y,
                         0.5f + 0.5f * (p.z / p.w - view.nearer));
    };
    for (const OverlayLine& line : lines) {
        const glm::vec4 a = view.to_clip * glm::vec4(line.from, 1), b = view.to_clip * glm::vec4(line.to, 1);
        const glm::vec4 from = before_eye(a, b), to = before_eye(b, a);
        if (!(from.z + from.w >= 0 && from.w > 0 && to.w > 0)) continue; // behind the eye, or not finite
        flat.push_back({place(from), place(to), 0.5f * line.width * view.scale, line.rgba});
    }
    return flat;
}

void draw_lines(std::span<const FlatLine> lines, int first, int end, const Pixels& pixels,
                std::uint32_t* picture) {
    for (const FlatLine& line : lines) Pen(line).draw(first, end, pixels, picture);
}

} // namespace knead
