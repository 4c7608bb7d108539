#include "io/format.h"
#include "io/las.h"
#include "io/pcd.h"
#include "io/ply.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace knead {

namespace {

constexpr std::array<std::string_view, 1> ply_extensions = {".ply"};

constexpr std::array<std::string_view, 1> las_extensions = {".las"};

constexpr std::array<std::string_view, 1> pcd_extensions = {".pcd"};

constexpr std::array<Format, 3> formats = {{
    {"ply", ply_extensions, looks_like_ply, read_ply, write_ply},
    {"las", las_extensions, looks_like_las, read_las, write_las},
    {"pcd", pcd_extensions, looks_like_pcd, read_pcd, write_pcd},
}};

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

} // namespace

std::span<const Format> known_formats() {
    return formats;
}

const Format* format_with_extension(const std::filesystem::path& path) {
    const std::string extension = lower_case(path.extension().string());
    for (const Format& format : formats)
        if (std::find(format.extensions.begin(), format.extensions.end(), extension) !=
            format.extensions.end())
            return &format;
    return nullptr;
}

std::string known_extensions() {
    std::string all;
    for (const Format& format : formats)
        for (const std::string_view extension : format.extensions)
            all.append(all.empty() ? "" : ", ").append(extension);
    return all;
}

} // namespace knead
