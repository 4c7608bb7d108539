#include "render/tinting.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr std::size_t distinct_handles = mark_handle; // 0 is none

// It may hide the file's colours: it does not stay.
constexpr float selection_share = 0.8f;

// A colour is mixed with another: its own share is (256 - share) / 256, and what it lends of its brightness.
struct Tint {
    std::uint32_t r = 0, g = 0, b = 0; // times share
    std::uint32_t share = 0;           // of 256
    std::uint32_t bits = tint_visible;
};

Tint tint_of(const glm::vec3& color, float share, std::uint32_t bits) {
    const auto part = [share](float c) {
        return static_cast<std::uint32_t>(std::clamp(c, 0.0f, 1.0f) * 255.0f * share * 256.0f + 0.5f);
    };
    return {part(color.r), part(color.g), part(color.b), static_cast<std::uint32_t>(share * 256.0f),
            tint_visible | bits};
}

std::uint32_t mixed(std::uint32_t rgb, const Tint& tint) {
    const std::uint32_t own = 256 - tint.share;
    const std::uint32_t r = ((rgb & 0xff) * own + tint.r) >> 8U;
    const std::uint32_t g = ((rgb >> 8U & 0xff) * own + tint.g) >> 8U;
    const std::uint32_t b = ((rgb >> 16U & 0xff) * own + tint.b) >> 8U;
    return r | g << 8U | b << 16U;
}

std::uint32_t bits_of(HandleLook::Pattern pattern) {
    switch (pattern) {
    case HandleLook::Pattern::solid:
        return 0;
    case HandleLook::Pattern::stripes:
        return tint_stripes;
    case HandleLook::Pattern::dots:
        return tint_dots;
    default:
        return tint_stripes | tint_dots;
    }
}

// One for every value of the lower six bits of a mark.
std::array<Tint, 1 + distinct_handles> handle_tints(std::span<const HandleLook> looks) {
    std::array<Tint, 1 + distinct_handles> tints;
    for (std::size_t i = 0; i < distinct_handles && !looks.empty(); ++i) {
        const HandleLook& look = looks[i % looks.size()];
        tints[1 + i] = tint_of(look.color, look.share, bits_of(look.pattern));
    }
    return tints;
}

} // namespace

void tint_colors(std::span<const std::uint32_t> colors, std::span<const std::uint8_t> marks,
                 std::span<const HandleLook> looks, std::span<std::uint32_t> tinted) {
    if (marks.empty()) {
        std::ranges::transform(colors, tinted.begin(),
                               [](std::uint32_t c) { return (c & 0xffffff) | tint_visible << 24U; });
        return;
    }
    const std::array<Tint, 1 + distinct_handles> tints = handle_tints(looks);
    const Tint selected = tint_of({1.0f, 0.62f, 0.08f}, selection_share, 0);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const Tint& tint = tints[marks[i] & mark_handle];
        std::uint32_t color = mixed(colors[i], tint);
        std::uint32_t bits = tint.bits;
        if (marks[i] & mark_selected) {
            color = mixed(color, selected);
            bits |= tint_selected;
        }
        tinted[i] = marks[i] & mark_hidden ? 0 : color | bits << 24U;
    }
}

} // namespace knead
