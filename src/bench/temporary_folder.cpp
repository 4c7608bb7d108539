#include "bench/temporary_folder.h"

#include "base/error.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace knead {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& text) {
    fs::path path(text);
    return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

TemporaryFolder::TemporaryFolder(const fs::path& target) : target_(target) {
    if (fs::exists(target) && !fs::is_directory(target))
        throw Error(Trouble::output, target.string(), "is a file; name a folder");
    const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::string name = (parent / ".knead-XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw Error(Trouble::output, target.string(),
                    "the folder cannot be made: " +
                        std::error_code(errno, std::generic_category()).message());
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void TemporaryFolder::hand_over(std::span<const std::string> names) const {
    try {
        fs::create_directories(target_);
        for (const std::string& name : names) fs::rename(path_ / name, target_ / name);
    } catch (const fs::filesystem_error& error) {
        throw Error(Trouble::output, target_.string(),
                    "the files cannot be put there: " + error.code().message());
    }
}

} // namespace knead
