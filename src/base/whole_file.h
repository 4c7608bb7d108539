#pragma once
// Files as wholes: read at once, and written so that the target is either its old self or complete.

#include "base/claim.h"
#include "base/progress.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace knead {

// All bytes of a file. Throws Error (input) naming the path when it is missing, a folder, unreadable, or
// shrinks while it is read. Reports through `progress` under the stage "reading".
std::vector<std::byte> read_whole_file(const std::filesystem::path& path, Progress& progress);

// The first bytes of a file, at most so many; none of what cannot be read or is no regular file. Never waits.
std::string first_bytes_of_file(const std::filesystem::path& path, std::size_t most);

// Tells a file from what it becomes when somebody writes to it or puts another one in its place.
struct FileStamp {
    dev_t device = 0;
    ino_t inode = 0;
    off_t size = 0;
    time_t seconds = 0;   // when its bytes were changed last,
    long nanoseconds = 0; // and of that second
    bool operator==(const FileStamp&) const = default;
};

// That of the file as it is now, links followed; nothing where there is no regular file. To know later
// whether a file still is what was read, take it before reading.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

// Throws Error (output): that `shown` cannot be written, why, after errno's `code`, and what helps.
[[noreturn]] void refuse_to_write(const std::filesystem::path& shown, int code);

// Makes names in a folder last: they are on the disk when this returns, where the file system can say so.
void sync_folder(const std::filesystem::path& folder);

// A file in the making beside its target: bytes go to a temporary name in the target's folder, a Claim;
// commit() syncs it and renames it over the target, keeping the permissions of a file that was there.
// Destroyed before that, it removes the temporary and leaves the target as it was; a process that is killed
// leaves the temporary, which the next one that writes the same target removes.
class FileInTheMaking {
public:
    // Throws Error (output) when the folder is missing or cannot be written to, and when `target` is a
    // folder, no regular file, or write-protected. A symbolic link is followed, so that the file it names is
    // replaced and the link stays.
    explicit FileInTheMaking(const std::filesystem::path& target);
    // Throws Error (output) when the disk is full or fails.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    const std::filesystem::path& shown() const { return shown_; }

    // Syncs, and throws Error (output) for all that commit() would, but for what befalls the disk in between:
    // for those who put several files in their places together.
    void make_ready();
    // Renames what was made ready, and syncs the folder.
    void put_in_place();
    // Both.
    void commit();

private:
    void follow_links();
    void refuse_target() const;

    std::filesystem::path shown_; // as the user named it, for errors
    std::filesystem::path target_;
    std::optional<Claim> temporary_; // none after commit()
};

} // namespace knead
