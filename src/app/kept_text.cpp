#include "app/kept_text.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "edit/journal.h"

#include <system_error>

namespace knead {

std::filesystem::path kept_file(const char* name) {
    const std::filesystem::path folder = default_journal_folder();
    return folder.empty() ? folder : folder / name;
}

void keep_text(const char* name, std::string_view text) {
    const std::filesystem::path target = kept_file(name);
    if (target.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(target.parent_path(), ignored);
    try {
        FileInTheMaking file(target);
        file.write(text);
        file.commit();
    } catch (const Error&) {
        return;
    }
}

} // namespace knead
