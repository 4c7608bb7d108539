#pragma once
// Which files are open in an editor, for the other editors of the same user to know. Nobody is kept from
// anything.

#include "base/claim.h"

#include <filesystem>
#include <optional>
#include <vector>

#include <sys/types.h>

namespace knead {

// Tells the other editors what this one has open, until it is destroyed or the process ends. Each has a file
// of its own under `open/` in the state folder, a Claim that holds the paths.
class OpenFiles {
public:
    // `state_folder`: as default_journal_folder() gives it. Where that is empty or cannot be written to,
    // nobody is told. Links are followed, so that one file is the same by any name.
    OpenFiles(const std::filesystem::path& state_folder, const std::vector<std::filesystem::path>& files);

    // The processes of the other editors that have this file open; this process's own documents do not count.
    std::vector<pid_t> others_with(const std::filesystem::path& file) const;

private:
    std::filesystem::path folder_;
    std::optional<Claim> entry_;
};

} // namespace knead
