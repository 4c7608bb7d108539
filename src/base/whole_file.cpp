#include "base/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace knead {

namespace {

std::string system_words(int code) {
    return std::generic_category().message(code);
}

std::string why_not_written(int code) {
    switch (code) {
    case ENOSPC:
    case EDQUOT:
        return "the disk is full; free some space or choose another place";
    case EFBIG:
        return "it would be larger than files may be here; choose another place";
    case EROFS:
        return "the disk is read-only; choose another place";
    case EACCES:
    case EPERM:
        return "there is no permission to write in its folder; choose another place";
    case ENOENT:
    case ENOTDIR:
        return "its folder is not there; make it, or choose another place";
    case ESTALE:
        return "somebody else took away what was written so far; try again";
    default:
        return system_words(code);
    }
}

Descriptor open_to_read(const std::filesystem::path& path) {
    return Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)); // a pipe must not block
}

// The process's umask. Setting it is the portable way to learn it, but another thread may make a file
// meanwhile.
mode_t file_mode_mask() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("Umask:"))
            return static_cast<mode_t>(std::strtoul(line.c_str() + std::strlen("Umask:"), nullptr, 8));
    return 077; // not told: nobody else may read it
}

} // namespace

std::vector<std::byte> read_whole_file(const std::filesystem::path& path, Progress& progress) {
    const Descriptor file = open_to_read(path);
    struct stat facts {};
    if (file.value() < 0 || ::fstat(file.value(), &facts) != 0)
        throw Error(Trouble::input, path.string(), "cannot be opened: " + system_words(errno));
    if (S_ISDIR(facts.st_mode)) throw Error(Trouble::input, path.string(), "is a folder, not a file");
    if (!S_ISREG(facts.st_mode)) throw Error(Trouble::input, path.string(), "is not a regular file");

    std::vector<std::byte> bytes(static_cast<std::size_t>(facts.st_size));
    constexpr std::size_t block = std::size_t{8} << 20;
    for (std::size_t done = 0; done < bytes.size();) {
        progress.step("reading", static_cast<double>(done) / static_cast<double>(bytes.size()));
        const ssize_t got = ::read(file.value(), bytes.data() + done, std::min(block, bytes.size() - done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw Error(Trouble::input, path.string(), "cannot be read: " + system_words(errno));
        if (got == 0)
            throw Error(Trouble::input, path.string(), "became shorter while it was read; try again");
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

std::string first_bytes_of_file(const std::filesystem::path& path, std::size_t most) {
    const Descriptor file = open_to_read(path);
    struct stat facts {};
    if (!file || ::fstat(file.value(), &facts) != 0 || !S_ISREG(facts.st_mode)) return {};
    std::string bytes(most, '\0');
    std::size_t done = 0;
    while (done < most) {
        const ssize_t got = ::read(file.value(), bytes.data() + done, most - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
}

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
    struct stat facts {};
    if (::stat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
    return FileStamp{facts.st_dev, facts.st_ino, facts.st_size, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec};
}

void refuse_to_write(const std::filesystem::path& shown, int code) {
    throw Error(Trouble::output, shown.string(), "cannot be written: " + why_not_written(code));
}

void sync_folder(const std::filesystem::path& folder) {
    const Descriptor descriptor(
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // Some file systems cannot sync a folder; what was renamed in it is already safe.
    if (descriptor) (void)::fsync(descriptor.value());
}

FileInTheMaking::FileInTheMaking(const std::filesystem::path& target) : shown_(target), target_(target) {
    follow_links();
    struct stat facts {};
    const bool is_there = ::stat(target_.c_str(), &facts) == 0;
    refuse_target();
    try {
        temporary_.emplace(Claim::beside(target_, Claim::Kind::file));
    } catch (const std::system_error& error) {
        refuse_to_write(shown_, error.code().value());
    }
    const mode_t mask = file_mode_mask();
    const int descriptor = temporary_->descriptor();
    if (is_there) (void)::fchown(descriptor, facts.st_uid, facts.st_gid); // as far as it is allowed
    (void)::fchmod(descriptor, is_there ? facts.st_mode & 07777 : 0666 & ~mask);
}

// To what the target names, which need not be there.
void FileInTheMaking::follow_links() {
    std::error_code trouble;
    if (!std::filesystem::is_symlink(target_, trouble)) return;
    if (std::filesystem::exists(target_, trouble)) { // then the system knows what it is
        const auto named = std::filesystem::canonical(target_, trouble);
        const bool is_path = !trouble && std::filesystem::equivalent(named, target_, trouble);
        if (is_path) target_ = named; // and not what /proc calls a pipe
        return;
    }
    constexpr int most_links = 40; // as Linux
    std::filesystem::path named = target_;
    for (int links = 0; std::filesystem::is_symlink(named, trouble); ++links) {
        if (links == most_links) return;
        named = named.parent_path() / std::filesystem::read_symlink(named, trouble);
        if (trouble) return;
    }
    target_ = named;
}

// What a renaming over the target would meet.
void FileInTheMaking::refuse_target() const {
    struct stat facts {};
    if (::stat(target_.c_str(), &facts) != 0) {
        if (errno == ENOENT) return; // nothing is there, or no folder, which the temporary meets
        refuse_to_write(shown_, errno);
    }
    if (S_ISDIR(facts.st_mode)) throw Error(Trouble::output, shown_.string(), "is a folder; name a file");
    if (!S_ISREG(facts.st_mode))
        throw Error(Trouble::output, shown_.string(), "is not a regular file; name another");
    if (::access(target_.c_str(), W_OK) != 0 && errno == EACCES)
        throw Error(Trouble::output, shown_.string(),
                    "is write-protected; allow writing to it, or choose another name");
    // In a sticky folder, as /tmp is, only the owner of a file or of the folder may rename over it.
    struct stat folder {};
    const std::filesystem::path parent = target_.has_parent_path() ? target_.parent_path() : ".";
    const bool is_sticky = ::stat(parent.c_str(), &folder) == 0 && (folder.st_mode & S_ISVTX) != 0;
    const uid_t user = ::geteuid();
    if (is_sticky && user != 0 && user != facts.st_uid && user != folder.st_uid)
        refuse_to_write(shown_, EPERM);
}

void FileInTheMaking::write(std::span<const std::byte> bytes) {
    if (const int code = write_all(temporary_->descriptor(), bytes); code != 0) refuse_to_write(shown_, code);
}

void FileInTheMaking::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void FileInTheMaking::make_ready() {
    if (::fsync(temporary_->descriptor()) != 0) refuse_to_write(shown_, errno);
    refuse_target();
    try {
        temporary_->refuse_if_away();
    } catch (const std::system_error& error) {
        refuse_to_write(shown_, error.code().value());
    }
}

void FileInTheMaking::commit() {
    make_ready();
    put_in_place();
}

void FileInTheMaking::put_in_place() {
    try {
        temporary_->rename_to(target_);
    } catch (const std::system_error& error) {
        refuse_to_write(shown_, error.code().value());
    }
    temporary_.reset();
    sync_folder(target_.parent_path());
}

} // namespace knead
