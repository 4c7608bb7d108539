#include "io/cloud_file.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "cloud/cloud_part.h"
#include "cloud/splats.h"
#include "io/format.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace knead {

namespace {

// --- What the user should hear -----------------------------------------------------------------------------

// The distance from |value| to the next float.
double float_step(double value) {
    const float magnitude = static_cast<float>(std::abs(value));
    return static_cast<double>(std::nextafter(magnitude, std::numeric_limits<float>::infinity()) - magnitude);
}

// Far from the origin, 4-byte coordinates lie on a grid that may be coarser than the scan.
void remark_on_coarse_coordinates(PointCloud& cloud, const Bounds& bounds) {
    constexpr double too_coarse = 1e-4; // of the diagonal; |center| is then about 1000 diagonals
    double step = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (cloud.attributes[cloud.coordinate_columns[axis]].type != ScalarType::float32) continue;
        const auto at = static_cast<Eigen::Index>(axis);
        step = std::max({step, float_step(bounds.lowest[at]), float_step(bounds.highest[at])});
    }
    if (!(bounds.diagonal() > 0) || step <= too_coarse * bounds.diagonal()) return;
    std::ostringstream words;
    words << "its 4-byte coordinates lie far from the origin, on a grid of " << step
          << ": the points are already rounded to it, and edits will be too";
    cloud.remarks.push_back(words.str());
}

// Normals that nobody knows the directions of.
void remark_on_normals_that_stay(PointCloud& cloud) {
    if (find_normals(cloud)) return;
    const auto columns = find_normal_names(cloud);
    if (!columns) return;
    const auto name = [&](std::size_t axis) { return cloud.attributes[(*columns)[axis]].name; };
    cloud.remarks.push_back("its normals " + name(0) + ", " + name(1) + " and " + name(2) +
                            " are neither floats nor of one type of whole numbers with a sign, of 1, 2 or 4 "
                            "bytes, so that nobody knows where they point; they are kept and do not turn "
                            "with the points");
}

void add_remarks(PointCloud& cloud) {
    const Bounds bounds = bounds_of(cloud);
    if (const std::size_t strange = cloud.size() - bounds.finite_points; strange > 0)
        cloud.remarks.push_back(
            std::to_string(strange) + " of " + std::to_string(cloud.size()) +
            " points have a coordinate that is not finite, or beyond what floats hold, or lie 10,000 times "
            "as far off as the others are spread; they are kept and never move");
    remark_on_coarse_coordinates(cloud, bounds);
    remark_on_normals_that_stay(cloud);
}

const Format& format_to_read(const std::filesystem::path& path, std::span<const std::byte> first_bytes) {
    const Format* const named = format_with_extension(path);
    if (named != nullptr && named->looks_like_with_its_name && named->looks_like_with_its_name(first_bytes))
        return *named;
    for (const Format& format : known_formats())
        if (format.looks_like(first_bytes)) return format;
    refuse_foreign_file(first_bytes, path.string());
    if (named != nullptr) return *named;
    throw Error(Trouble::input, path.string(),
                "is in no format that knead knows; it reads " + known_extensions() +
                    ", convert it to one of them");
}

const Format& format_to_write(const std::filesystem::path& path) {
    if (const Format* format = format_with_extension(path)) return *format;
    throw Error(Trouble::output, path.string(),
                "knead writes " + known_extensions() + "; give the file a name that ends in one of them");
}

} // namespace

PointCloud read_cloud(const std::filesystem::path& path, Progress& progress) {
    const std::string first_bytes = first_bytes_of_file(path, first_bytes_size);
    // What has no first bytes is left to the reader of whole files, which knows why.
    if (first_bytes.empty()) {
        (void)read_whole_file(path, progress);
        throw Error(Trouble::input, path.string(), "is empty; it holds no cloud");
    }
    const Format& format = format_to_read(path, std::as_bytes(std::span(first_bytes)));
    PointCloud cloud = format.read(read_whole_file(path, progress), path.string(), progress);
    add_remarks(cloud);
    return cloud;
}

void refuse_bad_target(const std::filesystem::path& path) {
    (void)format_to_write(path);
    const FileInTheMaking probe(path);
}

std::vector<std::string> write_cloud(const std::filesystem::path& path, const PointCloud& cloud,
                                     const PosedShape& shape, Progress& progress) {
    (void)format_to_write(path); // a wrong extension is told first
    FileInTheMaking file(path);
    std::vector<std::string> left_out = write_cloud(file, cloud, shape, progress);
    file.commit();
    return left_out;
}

std::vector<std::string> write_part(const std::filesystem::path& path, const PointCloud& cloud,
                                    const PosedShape& shape, std::span<const std::uint8_t> left_out,
                                    Progress& progress) {
    if (std::ranges::find(left_out, std::uint8_t{0}) == left_out.end())
        throw Error(Trouble::output, path.string(),
                    "would hold no points, since all of them are left out; leave out fewer");
    const PointCloud part = part_of(cloud, left_out);
    const std::vector<float> positions = part_of(shape.positions, 3, left_out);
    const std::vector<float> normals = part_of(shape.normals, 3, left_out);
    const std::vector<float> rotations = part_of(shape.rotations, 4, left_out);
    std::vector<std::vector<float>> added;
    for (const AddedColumn& column : shape.added) added.push_back(part_of(column.values, 1, left_out));
    PosedShape of_part{positions, normals, {}, rotations};
    for (std::size_t k = 0; k < added.size(); ++k) of_part.added.push_back({shape.added[k].name, added[k]});
    std::vector<std::string> words = write_cloud(path, part, of_part, progress);
    if (!cloud.image) return words;
    for (const std::string& what : cloud.image->besides_points())
        words.push_back(path.filename().string() +
                        ": what is there besides the points of the whole file is left out: " + what);
    return words;
}

std::vector<std::string> write_cloud(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                     Progress& progress) {
    const std::filesystem::path& path = file.shown();
    const Format& format = format_to_write(path);
    std::vector<std::string> left_out = format.write(file, cloud, shape, path.string(), progress);
    progress.stop_if_cancelled();
    if (cloud.image && cloud.image->format() != format.name)
        for (const std::string& what : cloud.image->besides_points())
            left_out.push_back("what only the file's own format keeps is left out: " + what);
    if (!shape.rotations.empty())
        if (const auto splats = find_splats(cloud); splats && splats->other_harmonics)
            left_out.emplace_back(
                "the view-dependent colours (f_rest_0 …) do not turn with the splats, since "
                "they are not the 9, 24 or 45 columns that knead knows how to turn");
    const std::string begin = path.filename().string() + ": ";
    for (std::string& words : left_out) words.insert(0, begin);
    return left_out;
}

FileKind file_kind(const PointCloud& cloud) {
    if (cloud.image) return {cloud.image->format(), cloud.image->encoding()};
    return {"ply", "binary_little_endian"};
}

bool has_cloud_extension(const std::filesystem::path& path) {
    return format_with_extension(path) != nullptr;
}

} // namespace knead
