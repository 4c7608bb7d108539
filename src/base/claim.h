#pragma once
// Names that a process holds for as long as it lives: what it makes under one is removed by whoever comes
// next if the process dies before it is done.
//
// A held name carries a lock of the kernel (flock), which ends with the process however that ends; nothing is
// ever told by age or by the number of a process. Where a file system has no such locks nothing is held, and
// nothing is taken for abandoned.

#include "base/descriptor.h"

#include <filesystem>
#include <optional>

namespace knead {

// A file or folder in the making. Destroyed before rename_to(), it is removed with all that is in it; what
// somebody else put under its name meanwhile is left alone.
class Claim {
public:
    enum class Kind { file, folder };

    // Makes an empty file or folder under this name; what a dead process left there is removed first. Nothing
    // where a living one holds the name, or where something else stands there. Throws std::system_error.
    static std::optional<Claim> of(const std::filesystem::path& name, Kind kind);

    // The same beside `target`, under the name of the target with ".knead-making" behind it, or
    // ".knead-making-2" … where that is held. So a later claim beside the same target clears away what was
    // left. Throws std::system_error.
    static Claim beside(const std::filesystem::path& target, Kind kind);

    ~Claim();
    Claim(Claim&& other) noexcept = default;
    Claim& operator=(Claim&&) = delete;

    const std::filesystem::path& path() const { return path_; }
    int descriptor() const { return descriptor_.value(); } // of a file: open for reading and writing

    // Whether path() still is what was made: false where its folder was moved or removed, and where something
    // else stands there.
    bool is_at_path() const;
    // Throws std::system_error where it is not, and where nothing may be renamed in its folder.
    void refuse_if_away() const;

    // Renames it over `target`, which must be in the same file system; then nothing is removed any more.
    // Throws std::system_error, also where refuse_if_away() does.
    void rename_to(const std::filesystem::path& target);

private:
    Claim(std::filesystem::path path, Kind kind, Descriptor folder)
        : path_(std::move(path)), kind_(kind), folder_(std::move(folder)) {}
    bool make();
    bool is_in(int folder, const std::filesystem::path& name) const;

    std::filesystem::path path_;
    Kind kind_;
    Descriptor folder_;     // that it is in, wherever that is moved
    Descriptor descriptor_; // carries the lock; none: nothing to remove
};

// Whether a living process holds this name. What a dead one left is removed.
bool is_held(const std::filesystem::path& name, Claim::Kind kind);

} // namespace knead
