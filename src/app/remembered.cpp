#include "app/remembered.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "edit/journal.h"

#include <fstream>
#include <string>
#include <string_view>

namespace knead {

namespace {

std::filesystem::path settings_file() {
    const std::filesystem::path folder = default_journal_folder();
    return folder.empty() ? folder : folder / "window";
}

} // namespace

UpAxis read_up_axis() {
    std::ifstream in(settings_file());
    std::string name, value;
    while (in >> name >> value)
        if (name == "up") return value == "y" ? UpAxis::y : UpAxis::z;
    return UpAxis::z;
}

void remember_up_axis(UpAxis up) {
    const std::filesystem::path target = settings_file();
    if (target.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(target.parent_path(), ignored);
    try {
        FileInTheMaking file(target);
        file.write(std::string_view(up == UpAxis::y ? "up y\n" : "up z\n"));
        file.commit();
    } catch (const Error&) {
        // A convenience; nothing of the user's work.
    }
}

} // namespace knead
