#pragma once
// Several files as a whole: made in a folder of their own, and put there when all are done.

#include "base/claim.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace knead {

// "frames/" is the folder "frames".
std::filesystem::path folder_of(const std::string& text);

// A folder beside `target`, or in it where it is there already, so that its files can be renamed into it; a
// Claim, gone with all that is in it when this is over. Throws Error (output) where it cannot be made, and
// where the target is a file.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const std::filesystem::path& target);

    const std::filesystem::path& path() const { return claim_->path(); }
    const std::filesystem::path& target() const { return target_; }
    std::vector<std::filesystem::path> names() const; // of what is in it

    // Throws Error (output) for all that hand_over() would, but for what befalls the disk in between.
    void make_ready() const;

    // Renames all files of the folder, which was made ready, into the target, or where that is not there the
    // folder itself to it. Other files of the target stay; a link is replaced, not followed. Throws Error
    // (output). Once only.
    void put_in_place();
    // Both: all or none, unless the disk fails half-way.
    void hand_over();

private:
    std::filesystem::path target_;
    std::optional<Claim> claim_; // none after hand_over()
};

} // namespace knead
