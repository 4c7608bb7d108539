#include "base/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace knead {

namespace {

std::string system_words(int code) {
    return std::generic_category().message(code);
}

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int value() const { return value_; }

private:
    int value_;
};

void sync_folder(const std::filesystem::path& folder) {
    const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // Some file systems cannot sync a folder; the renamed file itself is already safe.
    if (descriptor.value() >= 0) (void)::fsync(descriptor.value());
}

} // namespace

std::vector<std::byte> read_whole_file(const std::filesystem::path& path, Progress& progress) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)); // a pipe must not block
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

FileInTheMaking::FileInTheMaking(const std::filesystem::path& target) : shown_(target), target_(target) {
    std::error_code ignored;
    if (std::filesystem::is_symlink(target, ignored)) {
        const auto named = std::filesystem::weakly_canonical(target, ignored);
        if (!ignored) target_ = named;
    }
    if (std::filesystem::is_directory(target_, ignored))
        throw Error(Trouble::output, shown_.string(), "is a folder; name a file");
    std::string name = target_.string() + ".XXXXXX";
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be written");
    temporary_ = name;

    struct stat facts {};
    mode_t mode = 0;
    if (::stat(target_.c_str(), &facts) == 0) {
        mode = facts.st_mode & 07777;
    } else {
        const mode_t mask = ::umask(0);
        ::umask(mask);
        mode = 0666 & ~mask;
    }
    (void)::fchmod(descriptor_, mode);
}

FileInTheMaking::~FileInTheMaking() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void FileInTheMaking::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor_, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) fail("cannot be written");
        bytes = bytes.subspan(static_cast<std::size_t>(put));
    }
}

void FileInTheMaking::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void FileInTheMaking::commit() {
    if (::fsync(descriptor_) != 0) fail("cannot be written");
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail("cannot be written");
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be written");
    temporary_.clear();
    sync_folder(target_.has_parent_path() ? target_.parent_path() : std::filesystem::path("."));
}

void FileInTheMaking::fail(const char* doing) const {
    const int code = errno;
    throw Error(Trouble::output, shown_.string(), std::string(doing) + ": " + system_words(code));
}

} // namespace knead
