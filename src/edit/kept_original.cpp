#include "edit/kept_original.h"

#include "base/error.h"
#include "base/whole_file.h"

#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace knead {

std::filesystem::path name_of_original(const std::filesystem::path& cloud) {
    const std::string stem = cloud.stem().string() + "-original", extension = cloud.extension().string();
    std::filesystem::path name = cloud;
    name.replace_filename(stem + extension);
    std::error_code ignored;
    for (unsigned number = 2; std::filesystem::exists(std::filesystem::symlink_status(name, ignored));
         ++number)
        name.replace_filename(std::string(stem).append("-").append(std::to_string(number)).append(extension));
    return name;
}

void keep_original(const std::filesystem::path& cloud, const std::filesystem::path& copy,
                   Progress& progress) {
    constexpr std::size_t at_once = std::size_t{1} << 20;
    std::ifstream in(cloud, std::ios::binary);
    FileInTheMaking out(copy);
    std::vector<char> some(at_once);
    while (in.read(some.data(), static_cast<std::streamsize>(some.size())), in.gcount() > 0) {
        progress.stop_if_cancelled();
        out.write(std::as_bytes(std::span(some).first(static_cast<std::size_t>(in.gcount()))));
    }
    if (!in.eof()) throw Error(Trouble::input, cloud.string(), "cannot be read, so it cannot be kept");
    out.commit();
}

} // namespace knead
