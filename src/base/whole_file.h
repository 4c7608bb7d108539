#pragma once
// Files as wholes: read at once, and written so that the target is either its old self or complete.

#include "base/progress.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace knead {

// All bytes of a file. Throws Error (input) naming the path when it is missing, a folder, unreadable, or
// shrinks while it is read. Reports through `progress` under the stage "reading".
std::vector<std::byte> read_whole_file(const std::filesystem::path& path, Progress& progress);

// A file in the making beside its target: bytes go to a temporary name in the target's folder; commit() syncs
// it and renames it over the target, keeping the permissions of a file that was there. Destroyed before that,
// it removes the temporary and leaves the target as it was.
class FileInTheMaking {
public:
    // Throws Error (output) when the folder is missing or cannot be written to, or when `target` is a folder.
    // A symbolic link is followed, so that the file it names is replaced and the link stays.
    explicit FileInTheMaking(const std::filesystem::path& target);
    ~FileInTheMaking();
    FileInTheMaking(const FileInTheMaking&) = delete;
    FileInTheMaking& operator=(const FileInTheMaking&) = delete;

    // Throws Error (output) when the disk is full or fails.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    // Syncs, renames, and syncs the folder.
    void commit();

private:
    [[noreturn]] void fail(const char* doing) const;

    std::filesystem::path shown_; // as the user named it, for errors
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
};

} // namespace knead
