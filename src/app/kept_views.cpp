#include "app/kept_views.h"

#include "app/kept_text.h"
#include "edit/known_files.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace knead {

namespace {

constexpr const char* list_name = "views";
constexpr std::size_t most_views = 200;

// "pivot distance orientation offset orthographic up path", numbers as they are read again.
std::string line_of(const std::string& session, const Camera& camera) {
    const glm::dvec3& p = camera.pivot;
    const glm::dquat& q = camera.orientation;
    char numbers[400];
    std::snprintf(numbers, sizeof numbers,
                  "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %d %d ", p.x, p.y, p.z,
                  camera.distance, q.w, q.x, q.y, q.z, camera.offset.x, camera.offset.y,
                  camera.orthographic ? 1 : 0, static_cast<int>(camera.up));
    return numbers + session;
}

struct KeptView {
    std::string session;
    Camera camera;
};

std::optional<KeptView> read_line(const std::string& line) {
    std::istringstream in(line);
    KeptView view;
    Camera& camera = view.camera;
    glm::dquat& q = camera.orientation;
    int orthographic = 0, up = 0;
    in >> camera.pivot.x >> camera.pivot.y >> camera.pivot.z >> camera.distance >> q.w >> q.x >> q.y >> q.z >>
        camera.offset.x >> camera.offset.y >> orthographic >> up;
    in.get(); // the space before the path
    if (!std::getline(in, view.session) || up < 0 || up > static_cast<int>(UpAxis::minus_y))
        return std::nullopt;
    camera.orthographic = orthographic != 0;
    camera.up = static_cast<UpAxis>(up);
    const bool looks =
        std::isnormal(camera.distance) && camera.distance > 0 && std::abs(glm::length(q) - 1) < 1e-6;
    return looks ? std::optional(view) : std::nullopt;
}

std::vector<std::string> read_lines() {
    std::vector<std::string> lines;
    std::ifstream in(kept_file(list_name));
    for (std::string line; lines.size() < most_views && std::getline(in, line);) lines.push_back(line);
    return lines;
}

} // namespace

std::optional<Camera> kept_view(const std::filesystem::path& session) {
    const std::string name = real_name(session);
    for (const std::string& line : read_lines())
        if (const auto view = read_line(line); view && view->session == name) return view->camera;
    return std::nullopt;
}

void keep_view(const std::filesystem::path& session, const Camera& camera) {
    const std::string name = real_name(session);
    if (name.find('\n') != std::string::npos) return; // it cannot stand in a line
    std::string text = line_of(name, camera) + '\n';
    for (const std::string& line : read_lines())
        if (const auto view = read_line(line); view && view->session != name) text += line + '\n';
    keep_text(list_name, text);
}

void forget_views() {
    keep_text(list_name, "");
}

} // namespace knead
