#include "app/remembered.h"

#include "app/kept_text.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace knead {

namespace {

constexpr const char* settings_name = "window";

struct NamedAxis {
    const char* name;
    UpAxis up;
};
constexpr NamedAxis axes[] = {{"z", UpAxis::z}, {"y", UpAxis::y}, {"-y", UpAxis::minus_y}};

// "1440x900"
void take_size(const std::string& value, Remembered& choices) {
    int width = 0, height = 0;
    if (std::sscanf(value.c_str(), "%5dx%5d", &width, &height) != 2) return;
    if (width < 640 || height < 420 || width > 16384 || height > 16384) return; // nobody chose that
    choices.width = width;
    choices.height = height;
}

void take_panel(const std::string& value, Remembered& choices) {
    int width = 0;
    char more = 0;
    if (std::sscanf(value.c_str(), "%5d%c", &width, &more) == 1 && width >= least_panel &&
        width <= most_panel)
        choices.panel = width;
}

} // namespace

Remembered read_remembered() {
    Remembered choices;
    std::ifstream in(kept_file(settings_name));
    std::string name, value;
    while (in >> name >> value) {
        if (name == "up")
            if (const auto axis = std::ranges::find(axes, value, &NamedAxis::name); axis != std::end(axes))
                choices.up = axis->up;
        if (name == "samples") choices.choose_samples = value != "by-hand";
        if (name == "size") take_size(value, choices);
        if (name == "panel") take_panel(value, choices);
    }
    return choices;
}

void remember(const Remembered& choices) {
    const std::string up = std::ranges::find(axes, choices.up, &NamedAxis::up)->name;
    keep_text(settings_name,
              "up " + up + "\n" + (choices.choose_samples ? "samples automatic\n" : "samples by-hand\n") +
                  "size " + std::to_string(choices.width) + "x" + std::to_string(choices.height) + "\n" +
                  "panel " + std::to_string(choices.panel) + "\n");
}

} // namespace knead
