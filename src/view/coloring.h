#pragma once
// The colour of every point: the file's own, one for all, or a value told by colour, with what a legend
// needs.
//
// A colour is a word whose bytes in memory are r, g, b and 255.

#include "base/types.h"
#include "base/workers.h"
#include "cloud/point_cloud.h"
#include "view/camera.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

struct ValueRange {
    double low = 0, high = 1;
    bool operator==(const ValueRange&) const = default;
};

// What the colours tell.
struct ColorBy {
    enum class Kind {
        own,       // the file's own, see OwnColors; where it has none, or all are white, `plain`
        plain,     // `plain` for all
        height,    // along `up`, in the file's coordinates: -y where y points down
        normal,    // the direction of the normal: x, y, z as red, green, blue; where there are none, `plain`
        attribute, // the file's column called `attribute`
        values     // numbers that the caller computed (displacement, stretch)
    } kind = Kind::own;
    glm::vec3 plain{0.72f, 0.71f, 0.69f};
    std::string attribute;
    UpAxis up = UpAxis::z;           // of heights
    std::string title;               // of `values`, for the legend
    std::optional<ValueRange> range; // the ends of the scale; nothing: 1st to 99th percentile

    bool operator==(const ColorBy&) const = default;
};

// The points in the order in which they are drawn. Views.
struct PointsToColor {
    const PointCloud* cloud = nullptr; // for its columns and origin; never null
    std::span<const Index> file_index; // n: the place of each point in the cloud
    std::span<const float> positions;  // 3n, as posed
    std::span<const float> normals;    // 3n, unit, as posed; or empty
    std::span<const float> values;     // n for Kind::values; else not looked at
};

// What was told by colour.
struct Legend {
    std::string title;               // "Height", the column's name, …; empty where there is nothing to tell
    std::optional<ValueRange> range; // of the viridis scale, where it was used
};

// Fills n colours. Values beyond the range take the colour of its end, those that are not finite a dark grey.
// Throws Error (usage) where the cloud has no such column of scalars, naming those that it has.
Legend color_points(const ColorBy& by, const PointsToColor& points, std::span<std::uint32_t> colors,
                    Workers& workers);

// What a file says of how its points look: colours (columns red green blue, diffuse_red … or r g b), or else
// an intensity, which is shown in grey; of any type.
enum class OwnColors { none, intensity, rgb };
OwnColors own_colors(const PointCloud& cloud);

// The columns that points can be coloured by: every one of scalars but the coordinates.
std::vector<std::string> scalar_columns(const PointCloud& cloud);

// The scale's colour at `at`, 0 … 1 (clamped): viridis, of Stéfan van der Walt and Nathaniel Smith (2015),
// which is perceived as even, by the colour-blind too.
glm::vec3 viridis(double at);

} // namespace knead
