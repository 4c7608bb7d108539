#include "headless_scene.h"
#include "render/splats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace knead::test {
namespace {

constexpr Viewport screen{320, 200};
constexpr Pixel black{0, 0, 0};

Camera some_camera(bool orthographic) {
    Camera camera = first_view({glm::dvec3(-1), glm::dvec3(1)}, screen);
    camera.orthographic = orthographic;
    return camera;
}

// Random points in a ball, in no special order.
std::vector<float> ball(std::size_t n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    std::vector<float> positions;
    while (positions.size() < 3 * n) {
        const glm::vec3 p(coordinate(random), coordinate(random), coordinate(random));
        if (glm::length(p) < 1) positions.insert(positions.end(), {p.x, p.y, p.z});
    }
    return positions;
}

std::vector<std::uint32_t> many_colors(std::size_t n) {
    std::vector<std::uint32_t> colors;
    for (std::size_t i = 0; i < n; ++i)
        colors.push_back(rgba(static_cast<unsigned>(i * 37 % 256), static_cast<unsigned>(i * 91 % 256), 200));
    return colors;
}

std::size_t different_pixels(const std::vector<Pixel>& some, const std::vector<Pixel>& others) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < some.size(); ++i) count += some[i] != others[i] ? 1 : 0;
    return count;
}

class Drawing : public HeadlessScene {
protected:
    void put(std::vector<float> positions, std::span<const std::uint32_t> colors) {
        positions_ = std::move(positions);
        renderer->set_points(colors.size(), 0.1);
        renderer->set_positions(positions_);
        renderer->set_colors(colors);
    }

private:
    std::vector<float> positions_;
};

TEST_P(Drawing, a_splat_covers_the_pixels_around_its_projection) {
    const std::vector<float> point = {0.3f, -0.2f, 0.4f};
    for (const bool orthographic : {false, true}) {
        const Camera camera = some_camera(orthographic);
        put(point, std::vector{rgba(10, 200, 30)});
        flat.pixels = 9;
        const std::vector<Pixel> pixels = draw(camera, screen, flat);
        const glm::dvec2 middle = project(camera, screen, glm::dvec3(0.3f, -0.2f, 0.4f))->pixel;
        for (int y = 0; y < screen.height; ++y) {
            for (int x = 0; x < screen.width; ++x) {
                const glm::dvec2 here(x + 0.5, y + 0.5);
                const double distance = glm::distance(here, middle);
                if (distance < 3.9) {
                    EXPECT_EQ(at(pixels, screen, here), (Pixel{10, 200, 30})) << x << ' ' << y;
                }
                if (distance > 5.2) {
                    EXPECT_EQ(at(pixels, screen, here), black) << x << ' ' << y;
                }
            }
        }
    }
}

TEST_P(Drawing, by_distance_a_splat_is_as_large_as_its_spacing_there) {
    const std::vector<float> point = {0, 0, 0};
    const Camera camera = some_camera(false);
    flat.size_by_distance = true;
    const auto area = [&](float scale) {
        renderer->set_points(1, 0.2);
        renderer->set_positions(point);
        flat.scale = scale;
        std::ptrdiff_t lit = 0;
        for (const Pixel& pixel : draw(camera, screen, flat)) lit += pixel != black;
        return static_cast<double>(lit);
    };
    const double once = area(1);
    const double spacing = 0.2 / pixel_size_at(camera, screen, glm::dvec3(0));
    EXPECT_GT(std::sqrt(once), spacing); // a little more than its own square, or the surface would have holes
    EXPECT_LT(std::sqrt(once), 2.5 * spacing);
    EXPECT_NEAR(area(2) / once, 4, 0.5);
}

TEST_P(Drawing, near_points_hide_far_ones_whichever_comes_first) {
    const Camera camera = some_camera(false);
    const glm::vec3 eye(eye_of(camera));
    const glm::vec3 near = 0.3f * eye, far = -0.1f * eye;
    const glm::dvec2 pixel = project(camera, screen, glm::dvec3(near))->pixel;
    put(std::vector{near.x, near.y, near.z, far.x, far.y, far.z},
        std::vector{rgba(255, 0, 0), rgba(0, 0, 255)});
    EXPECT_EQ(at(draw(camera, screen, flat), screen, pixel), (Pixel{255, 0, 0}));
    put(std::vector{far.x, far.y, far.z, near.x, near.y, near.z},
        std::vector{rgba(0, 0, 255), rgba(255, 0, 0)});
    EXPECT_EQ(at(draw(camera, screen, flat), screen, pixel), (Pixel{255, 0, 0}));
}

TEST_P(Drawing, hidden_points_are_not_there) {
    const std::vector<float> points = {0, 0, 0, 0.5f, 0, 0};
    const Camera camera = some_camera(false);
    put(points, std::vector(2, rgba(255, 255, 255)));
    renderer->set_marks(std::vector<std::uint8_t>{mark_hidden, 0});
    const std::vector<Pixel> pixels = draw(camera, screen, flat);
    const auto seen = [&](double x) { return at(pixels, screen, project(camera, screen, {x, 0, 0})->pixel); };
    EXPECT_EQ(seen(0), black);
    EXPECT_EQ(seen(0.5), (Pixel{255, 255, 255}));
    renderer->set_marks({});
    EXPECT_NE(at(draw(camera, screen, flat), screen, project(camera, screen, {0, 0, 0})->pixel), black);
}

TEST_P(Drawing, selected_points_differ_on_every_colour) {
    const Camera camera = some_camera(false);
    const std::vector<float> point = {0, 0, 0};
    flat.pixels = 40;
    for (const std::uint32_t color :
         {rgba(255, 255, 255), rgba(0, 0, 0), rgba(255, 158, 20), rgba(30, 60, 200)}) {
        put(point, std::vector{color});
        const std::vector<Pixel> plain = draw(camera, screen, flat);
        renderer->set_marks(std::vector{mark_selected});
        const std::vector<Pixel> marked = draw(camera, screen, flat);
        int largest = 0;
        for (std::size_t i = 0; i < plain.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(plain[i][c] - marked[i][c]));
        EXPECT_GT(largest, 30) << std::hex << color;
    }
}

TEST_P(Drawing, handles_are_told_apart_without_colour) {
    const Camera camera = some_camera(false);
    put(std::vector<float>{0, 0, 0}, std::vector{rgba(90, 90, 90)});
    flat.pixels = 60;
    using Pattern = HandleLook::Pattern;
    const glm::vec3 color(0.2f, 0.6f, 1.0f);
    renderer->set_handle_looks(std::vector<HandleLook>{{color, Pattern::solid},
                                                       {color, Pattern::stripes},
                                                       {color, Pattern::dots},
                                                       {color, Pattern::stripes_and_dots}});
    const auto brightness = [&](const std::vector<Pixel>& picture) {
        const glm::ivec2 middle(project(camera, screen, {0, 0, 0})->pixel);
        double sum = 0;
        for (int y = -18; y <= 18; ++y)
            for (int x = -18; x <= 18; ++x)
                sum += at(picture, screen, glm::vec2(middle + glm::ivec2(x, y)))[2];
        return sum;
    };
    std::vector<std::vector<Pixel>> pictures;
    for (std::size_t handle = 0; handle < 4; ++handle) {
        renderer->set_marks(std::vector{handle_mark(handle)});
        pictures.push_back(draw(camera, screen, flat));
        const Pixel middle = at(pictures.back(), screen, project(camera, screen, {0, 0, 0})->pixel);
        EXPECT_GT(middle[2], middle[0] + 20) << handle; // tinted
    }
    EXPECT_NE(pictures[0], pictures[1]);
    EXPECT_NE(pictures[1], pictures[2]);
    EXPECT_NE(pictures[0], pictures[2]);
    for (std::size_t handle = 0; handle < 3; ++handle) EXPECT_NE(pictures[3], pictures[handle]);
    // Half are stripes, a quarter dots.
    const double solid = brightness(pictures[0]);
    EXPECT_NEAR(brightness(pictures[1]), 0.79 * solid, 0.03 * solid);
    EXPECT_NEAR(brightness(pictures[2]), 0.89 * solid, 0.03 * solid);
    renderer->set_marks(std::vector{handle_mark(63)}); // looks are used again
    EXPECT_EQ(draw(camera, screen, flat), pictures[0]);
}

TEST_P(Drawing, a_handle_without_a_tint_keeps_the_colours) {
    const Camera camera = some_camera(false);
    put(std::vector<float>{0, 0, 0}, std::vector{rgba(90, 120, 200)});
    flat.pixels = 60;
    const std::vector<Pixel> plain = draw(camera, screen, flat);
    renderer->set_marks(std::vector{handle_mark(0)});
    renderer->set_handle_looks(std::vector<HandleLook>{{glm::vec3(1, 0, 0), HandleLook::Pattern::solid, 0}});
    EXPECT_EQ(draw(camera, screen, flat), plain);
    renderer->set_handle_looks(
        std::vector<HandleLook>{{glm::vec3(1, 0, 0), HandleLook::Pattern::stripes, 0}});
    EXPECT_NE(draw(camera, screen, flat), plain);
}

TEST_P(Drawing, a_budget_is_kept_and_the_rest_follows) {
    constexpr std::size_t n = 20'000;
    const std::vector<float> positions = ball(n);
    const std::vector<std::uint32_t> colors = many_colors(n);
    PointLook look;
    for (const bool by_distance : {false, true}) {
        look.size_by_distance = by_distance;
        renderer->set_points(n, 0.02);
        renderer->set_positions(positions);
        renderer->set_colors(colors);
        const Camera camera = some_camera(false);
        const std::vector<Pixel> at_once = draw(camera, screen, look);
        renderer->set_positions(positions); // anew
        const GLuint to = target(screen);
        std::size_t calls = 1, drawn = 0;
        DrawResult result = renderer->draw(camera, screen, look, 3000, to);
        EXPECT_EQ(result.one_in, 7U);
        for (; !result.complete && calls < 100; ++calls) {
            EXPECT_LE(result.drawn, 3000U);
            if (calls > 1) drawn += result.drawn;
            result = renderer->draw(camera, screen, look, 3000, to);
        }
        EXPECT_EQ(drawn + result.drawn, n);
        EXPECT_EQ(calls, 8U);
        // Of two that lie at the same depth in a pixel the first one drawn is seen, which shades those
        // around.
        const std::vector<Pixel> by_and_by = read(screen);
        EXPECT_LE(different_pixels(by_and_by, at_once), 20U);
        EXPECT_EQ(renderer->draw(camera, screen, look, 3000, to).drawn, 0U);
        EXPECT_EQ(read(screen), by_and_by);
    }
}

// The even bits of a number, pushed together.
unsigned even_bits(unsigned number) {
    unsigned result = 0;
    for (unsigned bit = 0; bit < 16; ++bit) result |= (number >> 2 * bit & 1U) << bit;
    return result;
}

TEST_P(Drawing, a_few_points_of_a_dense_surface_close_it) {
    constexpr unsigned side = 512; // of a square, along the curve that the pipeline's order follows
    constexpr std::size_t n = std::size_t{side} * side;
    std::vector<float> positions;
    for (unsigned i = 0; i < n; ++i) {
        const auto place = [](unsigned along) { return static_cast<float>(2 * along) / side - 1; };
        positions.insert(positions.end(), {place(even_bits(i)), place(even_bits(i >> 1U)), 0});
    }
    renderer->set_points(n, 2.0 / side);
    renderer->set_positions(positions);
    renderer->set_colors(std::vector(n, rgba(255, 255, 255)));
    flat.size_by_distance = true;
    Camera camera = some_camera(true);
    look_at_side(camera, Side::top);
    for (const std::size_t budget : {n / 10, n / 40, n / 80}) {
        camera.distance *= 1.001; // another picture
        const GLuint to = target(screen);
        EXPECT_LE(renderer->draw(camera, screen, flat, budget, to).drawn, budget);
        const std::vector<Pixel> pixels = read(screen);
        std::size_t holes = 0;
        for (int y = 80; y < 120; ++y)
            for (int x = 140; x < 180; ++x) holes += at(pixels, screen, {x, y}) == black ? 1 : 0;
        EXPECT_LE(holes, 16U) << budget << ": one in a hundred";
    }
}

TEST(Splats, WhatGrewBeyondAFewPixelsKeepsAPartOfIt) {
    SplatView view;
    view.grown_to = 5;
    view.grown = 0.5F;
    EXPECT_FLOAT_EQ(diameter_of(view, 0.3F), 1) << "the smallest";
    EXPECT_FLOAT_EQ(diameter_of(view, 3), 3);
    EXPECT_FLOAT_EQ(diameter_of(view, 8), 5);
    EXPECT_FLOAT_EQ(diameter_of(view, 20), 10);
    EXPECT_FLOAT_EQ(diameter_of(view, 1000), 64) << "the largest";
    EXPECT_FLOAT_EQ(diameter_of(SplatView{}, 20), 20) << "nothing grew";
}

TEST_P(Drawing, any_change_starts_again) {
    constexpr std::size_t n = 4000;
    put(ball(n), many_colors(n));
    Camera camera = some_camera(false);
    const GLuint to = target(screen);
    const auto begins_again = [&] { return renderer->draw(camera, screen, flat, 1000, to).one_in == 4; };
    const auto finish = [&] {
        while (!renderer->draw(camera, screen, flat, 1000, to).complete) {
        }
    };
    EXPECT_TRUE(begins_again());
    finish();
    EXPECT_FALSE(begins_again());
    orbit(camera, Orbiting::turntable, {10, 0}, screen);
    EXPECT_TRUE(begins_again());
    finish();
    flat.pixels += 1;
    EXPECT_TRUE(begins_again());
    finish();
    renderer->set_marks(std::vector<std::uint8_t>(n, mark_selected));
    EXPECT_TRUE(begins_again());
}

TEST_P(Drawing, what_lies_outside_the_view_is_skipped_and_changes_nothing) {
    // Two clouds of whole chunks; the camera looks at one of them.
    std::vector<float> positions = ball(4096);
    std::vector<float> both = positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
        both.push_back(positions[i] + (i % 3 == 0 ? 1000.0f : 0.0f));
    Camera camera = some_camera(true);
    put(positions, many_colors(4096));
    const std::vector<Pixel> alone = draw(camera, screen, flat);
    put(both, many_colors(8192));
    const GLuint to = target(screen);
    EXPECT_EQ(renderer->draw(camera, screen, flat, 1'000'000, to).in_view, 4096U);
    EXPECT_EQ(read(screen), alone);
}

TEST_P(Drawing, fills_the_target_and_follows_its_size) {
    put(ball(1000), many_colors(1000));
    flat.background_top = flat.background_bottom = {0.2f, 0.4f, 0.6f};
    for (const Viewport size : {Viewport{64, 48}, Viewport{300, 10}, Viewport{1, 1}, Viewport{64, 48}}) {
        const std::vector<Pixel> pixels = draw(some_camera(false), size, flat);
        EXPECT_EQ(std::ranges::count(pixels, Pixel{255, 0, 255}), 0);
    }
}

TEST_P(Drawing, no_points_are_a_background) {
    put({}, {});
    for (const Pixel& pixel : draw(some_camera(false), screen, flat)) EXPECT_EQ(pixel, black);
    renderer->set_marks({});
    renderer->set_normals({});
    EXPECT_TRUE(renderer->draw(some_camera(true), screen, {}, 0, target(screen)).complete);
}

TEST_P(Drawing, points_that_are_not_finite_are_left_out) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    put(std::vector{nan, 0.f, 0.f, inf, 0.f, 0.f, 0.f, -inf, nan}, std::vector(3, rgba(255, 255, 255)));
    for (const Pixel& pixel : draw(some_camera(false), screen, flat)) EXPECT_EQ(pixel, black);
}

TEST_P(Drawing, normals_shade_and_both_sides_alike) {
    const Camera camera = some_camera(true);
    const glm::vec3 towards = glm::normalize(glm::vec3(eye_of(camera) - camera.pivot));
    const glm::vec3 across = glm::normalize(glm::cross(towards, glm::vec3(0, 0, 1)));
    flat.shading = true;
    const auto brightness = [&](const glm::vec3& n) {
        put(std::vector<float>{0, 0, 0}, std::vector{rgba(200, 200, 200)});
        const std::vector<float> normal = {n.x, n.y, n.z};
        renderer->set_normals(normal);
        return at(draw(camera, screen, flat), screen, project(camera, screen, {0, 0, 0})->pixel)[0];
    };
    EXPECT_GT(brightness(towards), brightness(across) + 20);
    EXPECT_NEAR(brightness(towards), brightness(-towards), 1);
    EXPECT_GT(brightness(across), 40); // never black
}

TEST_P(Drawing, a_splat_lies_in_the_surface) {
    // From above, of a surface that rises by two to the right, which narrows a disc.
    Camera camera = some_camera(true);
    look_at_side(camera, Side::top);
    const glm::dvec2 middle = project(camera, screen, {0, 0, 0})->pixel;
    flat.shading = true;
    flat.pixels = 60;
    for (const float side : {1.0f, -1.0f}) {
        put(std::vector<float>{0, 0, 0}, std::vector{rgba(200, 200, 200)});
        const std::vector<float> normal = {-2 * side, 0, side}; // of either direction and any length
        renderer->set_normals(normal);
        const std::vector<Pixel> pixels = draw(camera, screen, flat);
        const auto reach = [&](glm::dvec2 step) {
            double steps = 0;
            while (at(pixels, screen, middle + steps * step) != black) ++steps;
            return steps;
        };
        for (const double to : {1.0, -1.0}) {
            EXPECT_NEAR(reach({to, 0}), 30 / std::sqrt(3.0), 1);
            EXPECT_NEAR(reach({0, to}), 30, 1);
        }
    }
}

TEST_P(Drawing, wide_splats_of_a_slanting_plane_are_a_plane) {
    std::vector<float> positions, normals;
    for (int x = -40; x <= 40; ++x)
        for (int y = -40; y <= 40; ++y) {
            positions.insert(positions.end(),
                             {0.05f * static_cast<float>(x), 0.05f * static_cast<float>(y), 0});
            normals.insert(normals.end(), {0, 0, 1});
        }
    flat.shading = flat.eye_dome = true;
    flat.pixels = 24;
    for (const bool orthographic : {true, false}) {
        Camera camera = some_camera(orthographic);
        look_at_side(camera, Side::front);
        orbit(camera, Orbiting::turntable, {0, 50}, screen); // so that it is seen at a slant
        put(positions, std::vector(positions.size() / 3, rgba(200, 200, 200)));
        renderer->set_normals(normals);
        const std::vector<Pixel> pixels = draw(camera, screen, flat);
        const glm::dvec2 middle = project(camera, screen, {0, 0, 0})->pixel;
        int darkest = 255, lightest = 0;
        for (int x = -40; x <= 40; ++x)
            for (int y = -8; y <= 8; ++y) {
                const int brightness = at(pixels, screen, middle + glm::dvec2(x, y))[0];
                darkest = std::min(darkest, brightness);
                lightest = std::max(lightest, brightness);
            }
        EXPECT_GT(darkest, 0);
        EXPECT_LE(lightest - darkest, 2) << "steps from splat to splat, " << orthographic;
    }
}

TEST_P(Drawing, eye_dome_lighting_darkens_what_lies_behind_an_edge_only) {
    // A near sheet over the left half of a far one, seen from the top.
    std::vector<float> positions;
    for (int x = -60; x <= 60; ++x)
        for (int y = -40; y <= 40; ++y)
            for (const float value :
                 {0.02f * static_cast<float>(x), 0.02f * static_cast<float>(y), x < 0 ? 0.5f : 0.0f})
                positions.push_back(value);
    put(positions, std::vector(positions.size() / 3, rgba(200, 200, 200)));
    Camera camera = some_camera(true);
    look_at_side(camera, Side::top);
    camera.pivot = glm::dvec3(0);
    flat.eye_dome = true;
    const std::vector<Pixel> pixels = draw(camera, screen, flat);
    const auto row = [&](double x) {
        const glm::dvec2 edge = project(camera, screen, {0, 0, 0})->pixel;
        return at(pixels, screen, edge + glm::dvec2(x, 0))[0];
    };
    EXPECT_EQ(row(-30), 200);
    EXPECT_EQ(row(30), 200);
    int darkest = 255;
    for (int x = -8; x <= 8; ++x) darkest = std::min(darkest, row(x));
    EXPECT_LT(darkest, 140);
}

TEST_P(Drawing, overlay_lines_are_hidden_by_nearer_points_only) {
    const Camera camera = some_camera(true);
    const glm::vec3 towards = glm::normalize(glm::vec3(eye_of(camera) - camera.pivot));
    put(std::vector<float>{0, 0, 0}, std::vector{rgba(255, 255, 255)});
    flat.pixels = 20;
    const glm::dvec2 middle = project(camera, screen, {0, 0, 0})->pixel;
    const auto line_at = [&](float depth) {
        const glm::vec3 a = depth * towards;
        renderer->set_overlay(
            std::vector<OverlayLine>{{a - glm::vec3(0, 0, 1), a + glm::vec3(0, 0, 1), rgba(0, 255, 0), 3}});
        return at(draw(camera, screen, flat), screen, middle);
    };
    EXPECT_EQ(line_at(0.9f), (Pixel{0, 255, 0}));
    EXPECT_EQ(line_at(-0.9f), (Pixel{255, 255, 255}));
    renderer->set_overlay({});
    EXPECT_EQ(at(draw(camera, screen, flat), screen, middle), (Pixel{255, 255, 255}));
    renderer->set_overlay(
        std::vector<OverlayLine>{{0.9f * towards, 0.9f * towards, rgba(0, 0, 255), 7}}); // a point
    EXPECT_EQ(at(draw(camera, screen, flat), screen, middle), (Pixel{0, 0, 255}));
}

TEST_P(Drawing, both_ways_draw_the_same) {
    constexpr std::size_t n = 3000;
    const std::vector<float> positions = ball(n);
    PointRenderer other(GetParam() == PointRenderer::Drawing::by_opengl ? PointRenderer::Drawing::by_processor
                                                                        : PointRenderer::Drawing::by_opengl);
    using Pattern = HandleLook::Pattern;
    const std::vector<HandleLook> looks = {
        {{1, 0, 0}, Pattern::solid}, {{0, 1, 0}, Pattern::stripes}, {{0, 0, 1}, Pattern::dots}};
    std::vector<std::uint8_t> marks;
    for (std::size_t i = 0; i < n; ++i)
        marks.push_back(positions[3 * i] < -0.5f  ? handle_mark(i % 3)
                        : positions[3 * i] < 0.0f ? mark_selected
                                                  : std::uint8_t{0});
    const std::vector<OverlayLine> lines = {{{-1, -1, -1}, {1, 1, 1}, rgba(0, 255, 0), 2}};
    PointLook look; // as an artist sees it
    for (const bool with_normals : {true, false}) {
        for (const bool orthographic : {true, false}) {
            for (const double spacing : {0.005, 0.03, 0.2}) {
                std::vector<std::vector<Pixel>> pictures;
                for (PointRenderer* const one : {&*renderer, &other}) {
                    one->set_points(n, spacing);
                    one->set_positions(positions);
                    one->set_colors(many_colors(n));
                    one->set_marks(marks);
                    one->set_handle_looks(looks);
                    one->set_overlay(lines);
                    if (with_normals) one->set_normals(positions); // not of unit length, but alike
                    one->draw(some_camera(orthographic), screen, look, n, target(screen));
                    pictures.push_back(read(screen));
                }
                // A pixel at a rim may fall to either side, and darken those around it.
                std::size_t different = 0;
                for (std::size_t i = 0; i < pictures[0].size(); ++i)
                    for (std::size_t c = 0; c < 3; ++c)
                        if (std::abs(pictures[0][i][c] - pictures[1][i][c]) > 3) {
                            ++different;
                            break;
                        }
                EXPECT_LT(different, pictures[0].size() / 50)
                    << spacing << ' ' << with_normals << ' ' << orthographic;
            }
        }
    }
}

TEST_P(Drawing, an_overlay_that_comes_back_is_whole) {
    put({0, 0, 0, 0.1f, 0, 0}, std::vector(2, rgba(255, 255, 255)));
    const Camera camera = some_camera(false);
    const std::vector<OverlayLine> lines = {{{-1, -1, -1}, {1, 1, 1}, rgba(0, 255, 0), 3}};
    renderer->set_overlay(lines);
    const std::vector<Pixel> before = draw(camera, screen, flat);
    renderer->set_overlay({});
    Camera other = camera;
    other.distance *= 1.5;
    draw(other, screen, flat);
    draw(camera, screen, flat);
    renderer->set_overlay(lines);
    EXPECT_EQ(draw(camera, screen, flat), before);
}

TEST_P(Drawing, only_ranges_of_points_may_be_handed_over_again) {
    constexpr std::size_t n = 5 * points_in_chunk + 77;
    const std::vector<std::vector<PointRange>> changes = {
        {{0, 1}}, {{n - 1, n}}, {{1023, 1025}, {1500, 1501}, {4000, n}}, {}, {{2048, 3072}, {3072, 3073}},
        {{0, n}}};
    std::vector<float> positions = ball(n), normals = positions;
    const PointLook look; // with the normals
    put(positions, many_colors(n));
    renderer->set_normals(normals);
    PointRenderer anew(GetParam());
    const auto picture = [&](PointRenderer& one) {
        EXPECT_TRUE(one.draw(some_camera(false), screen, look, n, target(screen)).complete);
        return read(screen);
    };
    for (const std::vector<PointRange>& changed : changes) {
        for (const PointRange& range : changed)
            for (std::size_t i = 3 * range.first; i < 3 * range.end; ++i) {
                positions[i] *= -1.7f; // beyond the chunk's box, too
                normals[i] = -normals[i];
            }
        renderer->set_positions(positions, changed);
        renderer->set_normals(normals, changed);
        anew.set_points(n, 0.1);
        anew.set_positions(positions);
        anew.set_normals(normals);
        anew.set_colors(many_colors(n));
        ASSERT_EQ(picture(*renderer), picture(anew));
    }
    // The first time everything is handed over, whatever changed.
    renderer->set_points(n, 0.1);
    renderer->set_positions(positions, changes[0]);
    renderer->set_normals(normals, changes[0]);
    renderer->set_colors(many_colors(n));
    EXPECT_EQ(picture(*renderer), picture(anew));
}

INSTANTIATE_TEST_SUITE_P(Splats, Drawing, both_ways, name_of_way);

} // namespace
} // namespace knead::test
