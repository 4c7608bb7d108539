// The same as shaders/compose.frag, eight pixels at a time. Mesa's software renderer takes ten times as long.

#include "render/software_lines.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

constexpr int rows_at_once = 16; // by one thread

// GCC passes such vectors differently with and without AVX; these are always inlined.
#define KNEAD_INLINE [[gnu::always_inline]] inline
#define KNEAD_INLINED __attribute__((always_inline)) // a lambda
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

template<typename Vector, typename Item>
KNEAD_INLINE Vector load(const Item* from) {
    Vector v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

template<typename To, typename From>
KNEAD_INLINE To bits_as(From from) {
    To to;
    static_assert(sizeof to == sizeof from);
    std::memcpy(&to, &from, sizeof to);
    return to;
}

KNEAD_INLINE Floats splat_of(float value) {
    return value - Floats{};
}

KNEAD_INLINE Floats clamped(Floats v, float low, float high) {
    v = v < low ? splat_of(low) : v;
    return v > high ? splat_of(high) : v;
}

KNEAD_INLINE Floats fraction(Floats v) {
    Floats whole = __builtin_convertvector(__builtin_convertvector(v, Mask), Floats);
    whole = whole > v ? whole - 1.0f : whole;
    return v - whole;
}

// 2 to the v, to 5 digits, for |v| < 60.
KNEAD_INLINE Floats power_of_two(Floats v) {
    constexpr float shift = 12582912.0f; // adding it rounds to whole numbers
    const Floats shifted = v + shift, f = v - (shifted - shift);
    const Words whole = bits_as<Words>(shifted) - bits_as<Words>(splat_of(shift));
    const Floats part = 1.0f + f * (0.6931472f + f * (0.2402265f + f * (0.0555041f + f * 0.0096181f)));
    return bits_as<Floats>(bits_as<Words>(part) + (whole << 23));
}

KNEAD_INLINE Floats inverse_root(Floats v) {
    Floats r = bits_as<Floats>(0x5f375a86U - (bits_as<Words>(v) >> 1));
    for (int i = 0; i < 2; ++i) r = r * (1.5f - 0.5f * v * r * r);
    return r;
}

// The part of a slope beyond a threshold, at most 3.
KNEAD_INLINE Floats beyond(Floats slope, float threshold) {
    return clamped(slope - clamped(slope, -threshold, threshold), -3, 3);
}

KNEAD_INLINE Floats flatter(Floats there, Floats back) {
    const Floats there_size = there < 0.0f ? -there : there, back_size = back < 0.0f ? -back : back;
    return there_size < back_size ? there : -back;
}

// What has to be known of eight pixels.
struct Eight {
    Floats x, y; // their middles, from the lower left
    Floats depth, left, right, below, above, upper_left, upper_right, lower_left, lower_right; // depths
    Words colors, background;
};

KNEAD_INLINE Floats shade_of(const Eight& at, const ScreenPass& pass) {
    const Floats scale = pass.depth_scale.x / (pass.depth_scale.y + pass.depth_scale.z * at.depth);
    const float near = static_cast<float>(pass.near), far = static_cast<float>(pass.far);
    const Floats by_near = scale / near, by_far = scale / (1.41421f * far);
    const auto close = [&](Floats other)
                           KNEAD_INLINED { return beyond((at.depth - other) * by_near, pass.grain / near); };
    const Floats upper_right = (at.depth - at.upper_right) * by_far,
                 lower_left = (at.depth - at.lower_left) * by_far,
                 lower_right = (at.depth - at.lower_right) * by_far,
                 upper_left = (at.depth - at.upper_left) * by_far;
    const float far_step = 0.5f * pass.grain / far;
    const auto at_least = [](Floats v, float least) KNEAD_INLINED { return v < least ? splat_of(least) : v; };
    const Floats hollow_close = at_least(close(at.right) + close(at.left), -0.5f) +
                                at_least(close(at.above) + close(at.below), -0.5f);
    const Floats hollow_far = at_least(beyond(upper_right, far_step) + beyond(lower_left, far_step), -0.6f) +
                              at_least(beyond(lower_right, far_step) + beyond(upper_left, far_step), -0.6f);
    Floats shade = power_of_two(-pass.strength * (0.16f * hollow_close + 0.26f * hollow_far));
    if (pass.relief) {
        const Floats u = clamped(flatter(upper_right, lower_left), -3, 3);
        const Floats v = clamped(flatter(lower_right, upper_left), -3, 3);
        const Floats nx = -0.70711f * (u + v), ny = -0.70711f * (u - v);
        const Floats towards = nx * pass.key.x + ny * pass.key.y + pass.key.z;
        const Floats light = 0.5f + 0.5f * towards * inverse_root(nx * nx + ny * ny + 1.0f);
        shade = shade * (0.40f + 0.64f * light * light);
    }
    return shade;
}

struct Colors {
    Floats r, g, b; // 0 … 255
};

// Stripes and dots, told from the bits in alpha (tinting.h), and what is selected hatched in a light colour.
KNEAD_INLINE void add_patterns(const Eight& at, const ScreenPass& pass, Colors& colors, Floats& shade) {
    const Words bits = at.colors >> 24;
    bool any = false;
    for (int i = 0; i < lanes; ++i) any |= (bits[i] & 14U) != 0;
    if (!any) return;
    const Floats px = at.x / pass.pattern, py = at.y / pass.pattern;
    const Floats sum = fraction((px + py) / 9.0f), difference = fraction((px - py) / 9.0f);
    const Floats stripe = sum < 0.5f ? splat_of(0.58f) : splat_of(1);
    const Floats away = (sum - 0.5f) * (sum - 0.5f) + (difference - 0.5f) * (difference - 0.5f);
    const Floats dotted = away < 0.075f ? splat_of(0.55f) : splat_of(1);
    const Mask selected = (bits & 8U) != 0U;
    Floats lit = (bits & 2U) != 0U ? stripe : splat_of(1);
    lit = (bits & 4U) != 0U ? lit * dotted : lit;
    shade = selected ? shade : shade * lit;
    const Mask hatch = selected & (fraction((px - py) / 7.0f) >= 0.7f);
    const auto mixed = [&](Floats color, float with)
                           KNEAD_INLINED { return hatch ? 0.28f * color + 0.72f * 255.0f * with : color; };
    colors = {mixed(colors.r, 1.0f), mixed(colors.g, 0.95f), mixed(colors.b, 0.78f)};
}

KNEAD_INLINE Words as_bytes(Floats value) {
    return __builtin_convertvector(clamped(value + 0.5f, 0, 255.5f), Words);
}

KNEAD_INLINE Words composed(const Eight& at, const ScreenPass& pass) {
    const auto part = [&](int bits) KNEAD_INLINED {
        return __builtin_convertvector(at.colors >> bits & 0xffU, Floats);
    };
    Colors colors{part(0), part(8), part(16)};
    Floats shade = shade_of(at, pass);
    if (pass.patterns) add_patterns(at, pass, colors, shade);
    const Words drawn = as_bytes(colors.b * shade) | as_bytes(colors.g * shade) << 8 |
                        as_bytes(colors.r * shade) << 16 | 0xff000000U;
    return at.colors >> 24 != 0U ? drawn : at.background;
}

// The depths of some rows and those around them, the pixels at the edges repeated beyond them.
struct Surroundings {
    int first = 0; // row
    int far = 0;   // so many pixels more to each side
    std::size_t row = 0;
    std::vector<float> depths;

    Surroundings(const Pixels& pixels, int begin, int end, int reach) : first(begin - reach), far(reach) {
        const auto beyond = static_cast<std::size_t>(reach);
        row = pixels.row() + 2 * beyond;
        depths.resize(row * static_cast<std::size_t>(end + reach - first));
        for (int y = first; y < end + reach; ++y) {
            const auto from = static_cast<std::size_t>(std::clamp(y, 0, pixels.height - 1)) * pixels.row();
            float* const to = depths.data() + static_cast<std::size_t>(y - first) * row;
            const float* const begins = pixels.depths.data() + from;
            const float* const ends = begins + pixels.width;
            std::fill(to, to + beyond, *begins);
            std::copy(begins, ends, to + beyond);
            std::fill(to + beyond + pixels.width, to + row, ends[-1]);
        }
    }
    const float* at(int y) const { return depths.data() + static_cast<std::size_t>(y - first) * row + far; }
};

KNEAD_FOR_NEW_PROCESSORS_TOO
void compose_row(const ScreenPass& pass, const Surroundings& depths, int y, const std::uint32_t* colors,
                 const std::uint32_t* background, std::uint32_t* out) {
    constexpr Floats middles = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f};
    const int near = pass.near, far = pass.far;
    const float *here = depths.at(y), *up = depths.at(y - near), *down = depths.at(y + near),
                *far_up = depths.at(y - far), *far_down = depths.at(y + far);
    const float from_below = static_cast<float>(pass.viewport.height - 1 - y) + 0.5f;
    for (int x = pass.from.x; x < pass.to.x; x += lanes) {
        Eight at{};
        at.colors = load<Words>(colors + x);
        at.background = load<Words>(background + x);
        Words result = at.background;
        std::uint32_t any = 0;
        for (int i = 0; i < lanes; ++i) any |= at.colors[i];
        if (any != 0) {
            at.x = static_cast<float>(x) + middles;
            at.y = splat_of(from_below);
            at.depth = load<Floats>(here + x);
            at.left = load<Floats>(here + x - near);
            at.right = load<Floats>(here + x + near);
            at.above = load<Floats>(up + x);
            at.below = load<Floats>(down + x);
            at.upper_left = load<Floats>(far_up + x - far);
            at.upper_right = load<Floats>(far_up + x + far);
            at.lower_left = load<Floats>(far_down + x - far);
            at.lower_right = load<Floats>(far_down + x + far);
            result = composed(at, pass);
        }
        std::memcpy(out + x, &result, sizeof result);
    }
}

// As in the shader: Jimenez 2014, interleaved gradient noise, so that there are no bands in the dark.
float dither(float x, float y) {
    const auto fract = [](float v) { return v - std::floor(v); };
    return (fract(52.9829189f * fract(x * 0.06711056f + y * 0.00583715f)) - 0.5f) / 255.0f;
}

} // namespace

void SoftwareScreen::draw_background(const ScreenPass& pass, const Pixels& pixels, Workers& workers) {
    if (size_.width == pixels.width && size_.height == pixels.height && top_ == pass.top &&
        bottom_ == pass.bottom)
        return;
    size_ = {pixels.width, pixels.height};
    top_ = pass.top;
    bottom_ = pass.bottom;
    background_.assign(pixels.row() * static_cast<std::size_t>(pixels.height), 0xff000000U);
    workers.for_each(static_cast<std::size_t>(pixels.height), rows_at_once, [&](std::size_t row) {
        const float y = static_cast<float>(pixels.height) - 0.5f - static_cast<float>(row);
        const glm::vec3 color = glm::mix(bottom_, top_, y / static_cast<float>(pixels.height));
        for (int i = 0; i < pixels.width; ++i) {
            const float noise = dither(static_cast<float>(i) + 0.5f, y);
            const glm::vec3 c = glm::clamp(255.0f * (color + noise) + 0.5f, 0.0f, 255.0f);
            background_[row * pixels.row() + static_cast<std::size_t>(i)] =
                static_cast<std::uint32_t>(c.b) | static_cast<std::uint32_t>(c.g) << 8U |
                static_cast<std::uint32_t>(c.r) << 16U | 0xff000000U;
        }
    });
}

void SoftwareScreen::compose(const ScreenPass& pass, const Pixels& pixels, std::span<const FlatLine> lines,
                             Workers& workers) {
    draw_background(pass, pixels, workers);
    picture_.resize(background_.size());
    ScreenPass clipped = pass;
    clipped.from = glm::max(pass.from, glm::ivec2(0));
    clipped.to = glm::min(pass.to, glm::ivec2(pixels.width, pixels.height));
    const int first = pixels.height - clipped.to.y, end = pixels.height - clipped.from.y; // rows from the top
    const std::size_t length = pixels.row();
    const auto draw_rows = [&](int begins, int ends) {
        if (begins >= ends) return;
        const Surroundings depths(pixels, begins, ends, clipped.far);
        for (int y = begins; y < ends; ++y) {
            const std::size_t at = static_cast<std::size_t>(y) * length;
            compose_row(clipped, depths, y, pixels.colors.data() + at, background_.data() + at,
                        picture_.data() + at);
        }
    };
    workers.for_chunks(static_cast<std::size_t>(pixels.height), rows_at_once,
                       [&](std::size_t b, std::size_t e) {
                           std::copy(background_.data() + b * length, background_.data() + e * length,
                                     picture_.data() + b * length);
                           const int top = static_cast<int>(b), bottom = static_cast<int>(e);
                           draw_rows(std::max(first, top), std::min(end, bottom));
                           draw_lines(lines, top, bottom, pixels, picture_.data());
                       });
}

} // namespace knead
