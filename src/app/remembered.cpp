#include "app/remembered.h"

#include "app/kept_text.h"

#include <fstream>
#include <string>

namespace knead {

namespace {

constexpr const char* settings_name = "window";

} // namespace

Remembered read_remembered() {
    Remembered choices;
    std::ifstream in(kept_file(settings_name));
    std::string name, value;
    while (in >> name >> value) {
        if (name == "up") choices.up = value == "y" ? UpAxis::y : UpAxis::z;
        if (name == "samples") choices.choose_samples = value != "by-hand";
    }
    return choices;
}

void remember(const Remembered& choices) {
    const std::string up = choices.up == UpAxis::y ? "up y\n" : "up z\n";
    keep_text(settings_name, up + (choices.choose_samples ? "samples automatic\n" : "samples by-hand\n"));
}

} // namespace knead
