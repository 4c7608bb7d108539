#include "app/remembered.h"

#include "app/kept_text.h"

#include <fstream>
#include <string>

namespace knead {

namespace {

constexpr const char* settings_name = "window";

} // namespace

UpAxis read_up_axis() {
    std::ifstream in(kept_file(settings_name));
    std::string name, value;
    while (in >> name >> value)
        if (name == "up") return value == "y" ? UpAxis::y : UpAxis::z;
    return UpAxis::z;
}

void remember_up_axis(UpAxis up) {
    keep_text(settings_name, up == UpAxis::y ? "up y\n" : "up z\n");
}

} // namespace knead
