#pragma once
// A point cloud as it came from its file: positions to compute with, and every attribute as the file had it.

#include "base/types.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t size_of(ScalarType type);      // in bytes
std::string_view name_of(ScalarType type); // "int8" … "float64"
bool is_whole(ScalarType type);            // an integer of any width

// A named column: one scalar a point, or one list of scalars a point.
struct Attribute {
    std::string name; // as in the file, "red"
    ScalarType type = ScalarType::float32;
    std::vector<std::byte> values; // native byte order, tightly packed: n scalars, or all lists end to end

    // A list attribute holds the scalars first[i] … first[i + 1] - 1 for point i (n + 1 entries); a plain one
    // leaves it empty.
    std::vector<std::uint64_t> first;
    ScalarType count_type = ScalarType::uint8; // the type of the list's length in the file

    bool is_list() const { return !first.empty(); }
};

// The scalar number `at` of a column, as double. Exact for every type, integers of 8 bytes up to 2^53.
double value_at(const Attribute& attribute, std::size_t at);

// What a reader keeps of the file so that saving in the same format can leave every other byte as it was.
// Each format derives its own; only that format's writer looks inside.
struct SourceImage {
    virtual ~SourceImage() = default;

    virtual std::string_view format() const = 0;   // as in the table of formats, "ply"
    virtual std::string_view encoding() const = 0; // "ascii", "binary_compressed", "1.4, point format 6"

    // What it holds besides the points and their attributes, which only saving in the same format keeps: one
    // noun phrase each, "12 rows of the element face".
    virtual std::vector<std::string> besides_points() const { return {}; }
};

struct PointCloud {
    // Positions, x y z interleaved, 3n floats, relative to `origin`: the point lies at origin + position in
    // the file's coordinates and units. The origin is the middle of the bounding box of the finite points, or
    // of that of the main part, where strays make it 100 times as large (cloud/main_part.h).
    std::vector<float> positions;
    Vec3d origin = Vec3d::Zero();

    // All per-point columns in the order of the file, the coordinates among them with their own types.
    std::vector<Attribute> attributes;
    std::array<std::size_t, 3> coordinate_columns{}; // places of x, y, z in `attributes`

    std::vector<std::string> remarks; // what the user should hear about the file, one sentence each

    std::shared_ptr<const SourceImage> image; // null for a cloud that came from no file

    std::size_t size() const { return positions.size() / 3; }

    // Point i relative to the origin.
    Vec3f position(std::size_t i) const {
        return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    }

    // Point i as the file has it, exactly.
    Vec3d file_position(std::size_t i) const;
};

// The column called `name` (letter case counts), if there is one.
std::optional<std::size_t> find_attribute(const PointCloud& cloud, std::string_view name);

// The three columns that are called as normals are, of whatever types: nx ny nz, normal_x normal_y normal_z,
// NormalX NormalY NormalZ, or Nx Ny Nz, in this order of preference.
std::optional<std::array<std::size_t, 3>> find_normal_names(const PointCloud& cloud);

// The first such columns that are float32 or float64, or all three int8, int16 or int32.
std::optional<std::array<std::size_t, 3>> find_normals(const PointCloud& cloud);

// Normals as 3n floats, interleaved; empty without such columns.
std::vector<float> read_normals(const PointCloud& cloud);

// Whether all three coordinates of point i are finite, and not so far off that it is none of the cloud's
// (cloud/main_part.h). Others stay in the file and out of every computation.
bool is_finite(const PointCloud& cloud, std::size_t i);

// Fills `positions` and `origin` from the coordinate columns; readers and generators call it once, last.
void set_positions_from_columns(PointCloud& cloud);

// A cloud of the given columns x, y, z (float32) and no others; `positions` holds 3n floats in the file's
// coordinates.
PointCloud make_cloud(std::span<const float> positions);

// Appends a column of n scalars.
void add_attribute(PointCloud& cloud, std::string name, std::span<const float> values);
void add_attribute(PointCloud& cloud, std::string name, std::span<const std::uint8_t> values);

// The box around the finite points, in the file's coordinates.
struct Bounds {
    Vec3d lowest = Vec3d::Zero();
    Vec3d highest = Vec3d::Zero();
    std::size_t finite_points = 0; // with none, the box is the origin

    double diagonal() const { return (highest - lowest).norm(); } // "D", the unit in which errors are told
};
Bounds bounds_of(const PointCloud& cloud);

} // namespace knead
