#pragma once
// What a file format is to the rest of this room. Each format has files of its own; formats.cpp holds the
// table.

#include "base/whole_file.h"
#include "io/cloud_file.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

struct Format {
    std::string_view name; // as file_kind() tells it, "ply"
    std::span<const std::string_view>
        extensions;         // in lower case with the dot; the first one is the usual one
    std::string_view words; // what it holds or who reads it, to be chosen by: "any attributes"

    // Whether a file that begins with these bytes (up to `first_bytes_size`, fewer only where the file is
    // shorter) is of this format, good or bad. A format that can only be told by its extension says no.
    bool (*looks_like)(std::span<const std::byte> first_bytes);

    // The cloud in a file's bytes, which its image keeps. `shown` names the file in errors. Throws Error
    // (input) that names the file, the place in it and the cure.
    PointCloud (*read)(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

    // Writes all of a file that the caller has begun and will commit, and returns what write_cloud() does,
    // but for the target's name in front. A cloud whose image is of this format is patched, any other written
    // as a new file. `shown` names the target in errors.
    std::vector<std::string> (*write)(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                      const std::string& shown, Progress& progress);

    // Whether a file with one of its extensions that begins with these bytes is of this format, although its
    // content would make it one of another. Null: never.
    bool (*looks_like_with_its_name)(std::span<const std::byte> first_bytes) = nullptr;
};

constexpr std::size_t first_bytes_size = 65536;

// All of them, in the order in which content is tried.
std::span<const Format> known_formats();

// The one with this extension, letter case aside; null for none.
const Format* format_with_extension(const std::filesystem::path& path);

// Throws Error (input) that says what a file is that no format takes, by its first bytes, and the cure.
// Returns where they say nothing, so that the extension may decide.
void refuse_foreign_file(std::span<const std::byte> first_bytes, const std::string& shown);

} // namespace knead
