#include "cli/picture_options.h"

#include "base/error.h"
#include "base/quoted.h"
#include "base/whole_file.h"
#include "view/framing.h"
#include "view/standing.h"

#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace knead {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& wanted) {
    throw Error(Trouble::usage, "", option + " " + quoted(text) + ": " + wanted);
}

// Two numbers with a character between them, and nothing else.
template<typename Number>
std::optional<std::pair<Number, Number>> parse_two(const std::string& text, char between) {
    const char* const end = text.data() + text.size();
    std::pair<Number, Number> two{};
    const auto first = std::from_chars(text.data(), end, two.first);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != between) return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, two.second);
    if (second.ec != std::errc{} || second.ptr != end) return std::nullopt;
    return two;
}

// CLI::Range lets through what is no number.
CLI::Validator within(double low, double high) {
    return {[=](const std::string& text) {
                double value = 0;
                const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
                std::ostringstream words;
                if (!good) words << text << " is not between " << low << " and " << high;
                return words.str();
            },
            ""};
}

constexpr const char* picture_group = "Pictures";

} // namespace

void declare_picture_options(CLI::App& command, PictureOptions& options) {
    const std::string group = picture_group;
    command.add_option("--size", options.size, "Width and height in pixels, 1280x800")->group(group);
    command
        .add_option("--view", options.view,
                    "front, back, left, right, top, bottom, or AZIMUTH,ELEVATION in degrees")
        ->group(group);
    command
        .add_option("--up", options.up,
                    "Which axis points upwards: auto, which tells by what the cloud stands on, z, y, or -y "
                    "(as --up=-y; auto)")
        ->group(group);
    command
        .add_option("--color", options.color,
                    "What the colours tell: rgb, plain, height, normal, a column of the file, or in a "
                    "replay displacement "
                    "(default: rgb; where the file has none, its intensity in grey; or plain)")
        ->group(group);
    command.add_option("--zoom", options.zoom, "So many times as near as the whole cloud needs")
        ->check(within(0.01, 1000))
        ->group(group);
    command
        .add_option("--point-size", options.point_size,
                    "The diameter of all points in pixels (default: by distance)")
        ->check(within(0.5, 64))
        ->group(group);
    command
        .add_option("--background", options.background, "One colour, #rrggbb, instead of the dark gradient")
        ->group(group);
    command.add_flag("--orthographic", options.orthographic, "Without perspective")->group(group);
    command.add_flag("--no-eye-dome", options.flat, "Without the shading of edges and hollows")->group(group);
}

void refuse_picture_options(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        if (option->get_group() == picture_group && option->count() > 0)
            throw Error(
                Trouble::usage, option->get_name(),
                "is about pictures, and none is asked for; add --picture FILE.png or --frames FOLDER");
}

Viewport parse_size(const std::string& text, int largest) {
    const auto size = parse_two<int>(text, 'x');
    if (!size || size->first < 1 || size->second < 1 || size->first > largest || size->second > largest)
        refuse("--size", text,
               "a width and a height of 1 to " + std::to_string(largest) + " pixels, as 1280x800");
    return {size->first, size->second};
}

UpAxis parse_up(const std::string& text, std::span<const float> positions, const Vec3d& origin) {
    if (text == "z") return UpAxis::z;
    if (text == "y") return UpAxis::y;
    if (text == "-y") return UpAxis::minus_y;
    if (text == "auto") return standing_axis(positions, origin).value_or(UpAxis::z);
    refuse("--up", text, "z, y, -y or auto");
}

Camera camera_for(const PictureOptions& options, std::span<const float> positions,
                  std::span<const float> opened, const Vec3d& origin, Viewport viewport) {
    constexpr std::array<std::pair<const char*, Side>, 6> sides = {{{"front", Side::front},
                                                                    {"back", Side::back},
                                                                    {"right", Side::right},
                                                                    {"left", Side::left},
                                                                    {"top", Side::top},
                                                                    {"bottom", Side::bottom}}};
    Camera camera = first_view({}, viewport);
    camera.orthographic = options.orthographic;
    if (!options.view.empty()) {
        const auto side = std::ranges::find_if(sides, [&](const auto& s) { return options.view == s.first; });
        const auto degrees = parse_two<double>(options.view, ',');
        if (side != sides.end()) {
            look_at_side(camera, side->second);
        } else if (degrees && std::isfinite(degrees->first) && std::abs(degrees->second) <= 90) {
            constexpr double radian = std::numbers::pi / 180;
            look_at_side(camera, Side::front);
            camera.orientation = glm::angleAxis(degrees->first * radian, glm::dvec3(0, 0, 1)) *
                                 camera.orientation *
                                 glm::angleAxis(-degrees->second * radian, glm::dvec3(1, 0, 0));
        } else {
            refuse("--view", options.view,
                   "front, back, left, right, top, bottom, or AZIMUTH,ELEVATION in degrees, as 30,20");
        }
    }
    set_up(camera, parse_up(options.up, opened, origin));
    frame_points(camera, positions, viewport);
    camera.distance /= options.zoom;
    return camera;
}

ColorBy parse_color(const std::string& text) {
    ColorBy by;
    if (text.empty() || text == "rgb") {
        by.kind = ColorBy::Kind::own;
    } else if (text == "plain") {
        by.kind = ColorBy::Kind::plain;
    } else if (text == "height") {
        by.kind = ColorBy::Kind::height;
    } else if (text == "normal") {
        by.kind = ColorBy::Kind::normal;
    } else if (text == "displacement") {
        by.kind = ColorBy::Kind::values;
        by.title = text;
    } else {
        by.kind = ColorBy::Kind::attribute;
        by.attribute = text;
    }
    return by;
}

glm::vec3 parse_background(const std::string& text) {
    unsigned rgb = 0;
    const char* const end = text.data() + text.size();
    const bool good =
        text.size() == 7 && text[0] == '#' && std::from_chars(text.data() + 1, end, rgb, 16).ptr == end;
    if (!good) refuse("--background", text, "a colour as #204060");
    return glm::vec3(rgb >> 16U, rgb >> 8U & 255U, rgb & 255U) / 255.0f;
}

void refuse_bad_picture(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    if (extension != ".png")
        throw Error(Trouble::usage, path.string(), "pictures are PNG files; choose a name that ends in .png");
    const FileInTheMaking probe(path);
}

} // namespace knead
