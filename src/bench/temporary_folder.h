#pragma once
// Several files as a whole: made in a folder of their own beside the target, and put there when all are done.

#include <filesystem>
#include <span>
#include <string>

namespace knead {

// "frames/" is the folder "frames".
std::filesystem::path folder_of(const std::string& text);

// A folder with a name of its own beside `target`, gone with all that is in it when this is over. Throws
// Error (output) where it cannot be made, and where the target is a file.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const std::filesystem::path& target);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // Renames these files of the folder into the target, which is made if it is not there; other files in it
    // stay. Throws Error (output).
    void hand_over(std::span<const std::string> names) const;

private:
    std::filesystem::path target_, path_;
};

} // namespace knead
