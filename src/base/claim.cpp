#include "base/claim.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace knead {

namespace {

constexpr std::string_view suffix = ".knead-making";
constexpr std::size_t longest_name = 255; // bytes, of the usual file systems
constexpr int most_names = 1000;          // that may be held beside one target

[[noreturn]] void fail(int code) {
    throw std::system_error(code, std::generic_category());
}

// Waits for whoever looks at the moment whether it is abandoned. Without locks, there is none.
void lock(int descriptor) {
    while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
    }
}

bool is_same(const struct stat& a, const struct stat& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

enum class Found { nothing, held, other };

// Looks at a name, and removes what nobody holds there.
Found look_at(int folder, const std::filesystem::path& path, Claim::Kind kind) {
    const std::filesystem::path name = path.filename();
    const bool is_folder = kind == Claim::Kind::folder;
    const int how = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | (is_folder ? O_RDONLY | O_DIRECTORY : O_RDWR);
    const Descriptor found(::openat(folder, name.c_str(), how));
    if (!found) return errno == ENOENT ? Found::nothing : Found::other;
    struct stat facts {
    }, facts_of_name{};
    if (::fstat(found.value(), &facts) != 0 || (!is_folder && !S_ISREG(facts.st_mode))) return Found::other;
    if (::flock(found.value(), LOCK_EX | LOCK_NB) != 0)
        return errno == EWOULDBLOCK ? Found::held : Found::other;
    // Whoever held it until now may have given it another name just before: then it is not to be touched.
    if (::fstatat(folder, name.c_str(), &facts_of_name, AT_SYMLINK_NOFOLLOW) != 0 ||
        !is_same(facts, facts_of_name))
        return Found::nothing;
    std::error_code trouble;
    if (is_folder)
        std::filesystem::remove_all(path, trouble);
    else if (::unlinkat(folder, name.c_str(), 0) != 0)
        return Found::other;
    return trouble ? Found::other : Found::nothing;
}

std::filesystem::path folder_of_name(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

Descriptor open_folder_of(const std::filesystem::path& path) {
    const std::filesystem::path folder = folder_of_name(path);
    return Descriptor(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
}

} // namespace

std::optional<Claim> Claim::of(const std::filesystem::path& name, Kind kind) {
    Claim claim(name, kind, open_folder_of(name));
    if (!claim.folder_) fail(errno);
    while (!claim.make())
        if (look_at(claim.folder_.value(), name, kind) != Found::nothing) return std::nullopt;
    return claim;
}

Claim Claim::beside(const std::filesystem::path& target, Kind kind) {
    for (int number = 1; number <= most_names; ++number) {
        std::string behind(suffix);
        if (number > 1) behind += '-' + std::to_string(number);
        const std::string name = target.filename().string().substr(0, longest_name - behind.size());
        if (auto claim = of(target.parent_path() / (name + behind), kind)) return std::move(*claim);
    }
    fail(EEXIST);
}

// False where the name is taken.
bool Claim::make() {
    const std::string name = path_.filename().string();
    const int folder = folder_.value();
    if (kind_ == Kind::file) {
        descriptor_ = Descriptor(
            ::openat(folder, name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    } else if (::mkdirat(folder, name.c_str(), 0777) == 0) {
        descriptor_ =
            Descriptor(::openat(folder, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!descriptor_ && errno == ENOENT) return false; // taken for abandoned already
    }
    if (!descriptor_) {
        if (errno == EEXIST) return false;
        fail(errno);
    }
    lock(descriptor_.value());
    if (is_in(folder, name)) return true;
    descriptor_ = Descriptor(); // taken for abandoned in the moment before the lock
    return false;
}

bool Claim::is_in(int folder, const std::filesystem::path& name) const {
    struct stat facts {
    }, facts_of_name{};
    return ::fstat(descriptor_.value(), &facts) == 0 &&
           ::fstatat(folder, name.c_str(), &facts_of_name, AT_SYMLINK_NOFOLLOW) == 0 &&
           is_same(facts, facts_of_name);
}

bool Claim::is_at_path() const {
    return is_in(AT_FDCWD, path_);
}

Claim::~Claim() {
    if (!descriptor_) return;
    std::error_code ignored;
    if (kind_ == Kind::folder && is_at_path()) std::filesystem::remove_all(path_, ignored);
    if (kind_ == Kind::file && is_in(folder_.value(), path_.filename()))
        (void)::unlinkat(folder_.value(), path_.filename().c_str(), 0);
}

void Claim::refuse_if_away() const {
    if (::access(folder_of_name(path_).c_str(), W_OK) != 0) fail(errno);
    if (!is_at_path()) fail(ESTALE);
}

void Claim::rename_to(const std::filesystem::path& target) {
    refuse_if_away();
    if (::renameat(folder_.value(), path_.filename().c_str(), AT_FDCWD, target.c_str()) != 0) fail(errno);
    descriptor_ = Descriptor();
}

bool is_held(const std::filesystem::path& name, Claim::Kind kind) {
    const Descriptor folder = open_folder_of(name);
    return folder && look_at(folder.value(), name, kind) == Found::held;
}

} // namespace knead
