#include "app/kept_views.h"

#include "app/kept_text.h"
#include "edit/known_files.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

namespace {

constexpr const char* list_name = "views";
constexpr std::size_t most_views = 200;

constexpr std::string_view axes = "xyz";

// "pivot distance orientation offset orthographic up path", numbers as they are read again; with the letter
// of the axis across which moves are mirrored right behind `up`, and behind the path a tab and the handle
// that was chosen.
std::string line_of(const std::string& session, const KeptView& view) {
    const Camera& camera = view.camera;
    const glm::dvec3& p = camera.pivot;
    const glm::dquat& q = camera.orientation;
    char numbers[400];
    std::snprintf(numbers, sizeof numbers,
                  "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %d %d", p.x, p.y, p.z,
                  camera.distance, q.w, q.x, q.y, q.z, camera.offset.x, camera.offset.y,
                  camera.orthographic ? 1 : 0, static_cast<int>(camera.up));
    std::string text = numbers;
    if (view.mirror_axis) text += axes.at(static_cast<std::size_t>(*view.mirror_axis));
    const bool fits = view.chosen.find_first_of("\t\n") == std::string::npos;
    return text + ' ' + session + '\t' + (fits ? view.chosen : "");
}

struct Line {
    std::string session;
    KeptView view;
};

std::optional<Line> read_line(const std::string& text) {
    std::istringstream in(text);
    Line line;
    Camera& camera = line.view.camera;
    glm::dquat& q = camera.orientation;
    int orthographic = 0, up = 0;
    in >> camera.pivot.x >> camera.pivot.y >> camera.pivot.z >> camera.distance >> q.w >> q.x >> q.y >> q.z >>
        camera.offset.x >> camera.offset.y >> orthographic >> up;
    if (const auto axis = axes.find(static_cast<char>(in.peek())); axis != std::string_view::npos) {
        line.view.mirror_axis = static_cast<int>(axis);
        in.get();
    }
    in.get(); // the space before the path
    if (!std::getline(in, line.session) || up < 0 || up > static_cast<int>(UpAxis::minus_y))
        return std::nullopt;
    if (const std::size_t tab = line.session.rfind('\t'); tab != std::string::npos) {
        line.view.chosen = line.session.substr(tab + 1);
        line.session.resize(tab);
    }
    camera.orthographic = orthographic != 0;
    camera.up = static_cast<UpAxis>(up);
    const bool looks =
        std::isnormal(camera.distance) && camera.distance > 0 && std::abs(glm::length(q) - 1) < 1e-6;
    return looks ? std::optional(line) : std::nullopt;
}

std::vector<std::string> read_lines() {
    std::vector<std::string> lines;
    std::ifstream in(kept_file(list_name));
    for (std::string line; lines.size() < most_views && std::getline(in, line);) lines.push_back(line);
    return lines;
}

} // namespace

std::optional<KeptView> kept_view(const std::filesystem::path& session) {
    const std::string name = real_name(session);
    for (const std::string& text : read_lines())
        if (const auto line = read_line(text); line && line->session == name) return line->view;
    return std::nullopt;
}

void keep_view(const std::filesystem::path& session, const KeptView& view) {
    const std::string name = real_name(session);
    if (name.find('\n') != std::string::npos) return; // it cannot stand in a line
    std::string all = line_of(name, view) + '\n';
    for (const std::string& text : read_lines())
        if (const auto line = read_line(text); line && line->session != name) all += text + '\n';
    keep_text(list_name, all);
}

void forget_views() {
    keep_text(list_name, "");
}

} // namespace knead
