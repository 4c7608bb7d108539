#include "base/temporary_folder.h"

#include "base/error.h"
#include "base/whole_file.h"

#include <system_error>

namespace knead {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& text) {
    fs::path path(text);
    return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

TemporaryFolder::TemporaryFolder(const fs::path& target) : target_(target) {
    try {
        const bool is_there = fs::is_directory(target);
        if (!is_there && fs::exists(target))
            throw Error(Trouble::output, target.string(), "is a file; name a folder");
        claim_.emplace(Claim::beside(is_there ? target / "" : target, Claim::Kind::folder));
    } catch (const std::system_error& error) {
        refuse_to_write(target, error.code().value());
    }
}

std::vector<fs::path> TemporaryFolder::names() const {
    std::vector<fs::path> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(path()))
        names.push_back(entry.path().filename());
    return names;
}

void TemporaryFolder::make_ready() const {
    try {
        claim_->refuse_if_away();
        for (const fs::path& name : names())
            if (fs::is_directory(fs::symlink_status(target_ / name)))
                throw Error(Trouble::output, (target_ / name).string(),
                            "is a folder; a file is to be put there");
    } catch (const std::system_error& error) {
        refuse_to_write(target_, error.code().value());
    }
}

void TemporaryFolder::hand_over() {
    make_ready();
    put_in_place();
}

void TemporaryFolder::put_in_place() {
    try {
        if (fs::is_directory(target_))
            for (const fs::path& name : names()) fs::rename(path() / name, target_ / name);
        else
            claim_->rename_to(target_);
    } catch (const std::system_error& error) {
        refuse_to_write(target_, error.code().value());
    }
    sync_folder(target_);
    sync_folder(target_.parent_path());
    claim_.reset();
}

} // namespace knead
