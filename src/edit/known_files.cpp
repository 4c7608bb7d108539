#include "edit/known_files.h"

#include <system_error>

namespace knead {

namespace {

// By the links that were asked for.
std::string plain_name(const std::filesystem::path& file) {
    std::error_code trouble;
    const std::filesystem::path whole = std::filesystem::absolute(file, trouble);
    return trouble ? file.string() : whole.lexically_normal().string();
}

} // namespace

std::string real_name(const std::filesystem::path& file) {
    std::error_code trouble;
    const std::filesystem::path real =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, trouble), trouble);
    return trouble ? file.string() : real.string();
}

void take_note(KnownFiles& known, const std::filesystem::path& file) {
    if (const auto stamp = stamp_of(file)) take_note(known, file, *stamp);
}

void take_note(KnownFiles& known, const std::filesystem::path& file, const FileStamp& stamp) {
    known.stamps[real_name(file)] = known.stamps[plain_name(file)] = stamp;
}

bool was_changed(const KnownFiles& known, const std::filesystem::path& file) {
    auto before = known.stamps.find(real_name(file));
    // A link on the way now leads to a file that was never read.
    if (before == known.stamps.end()) before = known.stamps.find(plain_name(file));
    const auto now = stamp_of(file);
    return before != known.stamps.end() && now && *now != before->second;
}

} // namespace knead
