#include "io/cloud_file.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "io/ply.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace knead {

namespace {

// --- The formats that knead reads and writes ---------------------------------------------------------------

struct Format {
    std::string_view name;
    std::string_view extension;
    bool (*looks_like)(std::span<const std::byte> first_bytes);
    PointCloud (*read)(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);
    void (*write)(const std::filesystem::path& path, const PointCloud& cloud, const PosedShape& shape,
                  Progress& progress);
};

constexpr std::array<Format, 1> formats = {{
    {"ply", ".ply", looks_like_ply, read_ply, write_ply},
}};

constexpr const char* reads_ply = "this version of knead reads PLY; convert it to PLY";

// --- The formats that it only knows by sight ---------------------------------------------------------------

struct Signature {
    std::string_view begins;
    std::string_view words; // "is ..."
};

constexpr std::array<Signature, 26> signatures = {{
    {"\xEF\xBB\xBFply", "is a PLY file behind a byte-order mark; save it again without the mark"},
    {"\xFF\xFE", "is text in UTF-16; save it again as plain ASCII"},
    {"\xFE\xFF", "is text in UTF-16; save it again as plain ASCII"},
    {"# .PCD", "is a PCD file"},
    {"VERSION .7", "is a PCD file"},
    {"VERSION 0.7", "is a PCD file"},
    {"LASF", "is a LAS or LAZ file"},
    {"ASTM-E57", "is an E57 file"},
    {"OFF", "is an OFF file"},
    {"COFF", "is an OFF file"},
    {"NOFF", "is an OFF file"},
    {"CNOFF", "is an OFF file"},
    {"STOFF", "is an OFF file"},
    {"solid", "is an STL file"},
    {"glTF", "is a glTF file"},
    {"mtllib ", "is an OBJ file"},
    {"usemtl ", "is an OBJ file"},
    {"v ", "is an OBJ file"},
    {"o ", "is an OBJ file"},
    {"g ", "is an OBJ file"},
    {"vn ", "is an OBJ file"},
    {"vt ", "is an OBJ file"},
    {"\x1F\x8B", "is compressed with gzip; unpack it first"},
    {"PK\x03\x04", "is a ZIP archive; unpack it first"},
    {"{\"knead\"", "is a knead session, not a cloud; 'knead replay' runs it"},
    {"ply", "begins like a PLY file, but 'ply' must stand alone on its first line"},
}};

// The first line that says something: neither empty nor a comment, as OBJ and tables of numbers have them.
std::string_view first_line(std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view line = text.substr(0, end);
        if (!line.empty() && !line.starts_with('#')) return line;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return {};
}

bool is_row_of_numbers(std::string_view line) {
    std::string words(line);
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    std::istringstream numbers(words);
    double number = 0;
    int found = 0;
    while (numbers >> number) ++found;
    return found >= 3 && numbers.eof();
}

[[noreturn]] void refuse(const std::string& shown, std::string_view text) {
    const auto is = [&](std::string_view begin, const Signature& signature) {
        return begin.starts_with(signature.begins);
    };
    for (const std::string_view begin : {text, first_line(text)})
        for (const Signature& signature : signatures) {
            if (!is(begin, signature)) continue;
            const bool has_cure = signature.words.find(';') != std::string_view::npos;
            throw Error(Trouble::input, shown,
                        std::string(signature.words) + (has_cure ? "" : std::string("; ") + reads_ply));
        }
    if (is_row_of_numbers(first_line(text)))
        throw Error(Trouble::input, shown, std::string("is a table of numbers; ") + reads_ply);
    throw Error(Trouble::input, shown, std::string("is in no format that knead knows; ") + reads_ply);
}

// Up to 512 bytes; none of what cannot be read.
std::vector<std::byte> first_bytes_of(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {};
    std::vector<char> text(512);
    std::ifstream file(path, std::ios::binary);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    const auto bytes = std::as_bytes(std::span(text).first(static_cast<std::size_t>(file.gcount())));
    return {bytes.begin(), bytes.end()};
}

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

void add_remarks(PointCloud& cloud) {
    const Bounds bounds = bounds_of(cloud);
    if (const std::size_t strange = cloud.size() - bounds.finite_points; strange > 0)
        cloud.remarks.push_back(std::to_string(strange) + " of " + std::to_string(cloud.size()) +
                                " points have a coordinate that is not finite; they are kept and never move");
    remark_on_coarse_coordinates(cloud, bounds);
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

const Format& format_for(const std::filesystem::path& path) {
    const std::string extension = lower_case(path.extension().string());
    for (const Format& format : formats)
        if (extension == format.extension) return format;
    throw Error(Trouble::output, path.string(),
                "knead writes PLY so far; give the file a name that ends in .ply");
}

} // namespace

PointCloud read_cloud(const std::filesystem::path& path, Progress& progress) {
    const auto first_bytes = first_bytes_of(path);
    const std::string_view text(reinterpret_cast<const char*>(first_bytes.data()), first_bytes.size());
    const auto format = std::find_if(formats.begin(), formats.end(),
                                     [&](const Format& known) { return known.looks_like(first_bytes); });
    // What has no first bytes is left to the reader of whole files, which knows why.
    if (format == formats.end() && !first_bytes.empty()) refuse(path.string(), text);
    std::vector<std::byte> bytes = read_whole_file(path, progress);
    if (format == formats.end()) throw Error(Trouble::input, path.string(), "is empty; it holds no cloud");
    PointCloud cloud = format->read(std::move(bytes), path.string(), progress);
    add_remarks(cloud);
    return cloud;
}

void refuse_bad_target(const std::filesystem::path& path) {
    (void)format_for(path);
    const FileInTheMaking probe(path);
}

void write_cloud(const std::filesystem::path& path, const PointCloud& cloud, const PosedShape& shape,
                 Progress& progress) {
    format_for(path).write(path, cloud, shape, progress);
}

FileKind file_kind(const PointCloud& cloud) {
    if (const auto* image = dynamic_cast<const PlyImage*>(cloud.image.get()))
        return {"ply", name_of(image->header.encoding)};
    return {"ply", name_of(PlyEncoding::binary_little_endian)};
}

} // namespace knead
