#pragma once
// The order in which points are computed with, and which of them are one vertex of the graph.
//
// Points are ordered along the Morton curve: neighbours in space are neighbours in memory, which makes every
// later stage two to three times faster, and a cell of an octree is a range. Points at exactly the same
// position follow each other and share a graph vertex, or they would fill each other's lists of neighbours.

#include "base/progress.h"
#include "base/types.h"
#include "base/workers.h"

#include <span>
#include <utility>
#include <vector>

namespace knead {

// A number for each of 0, 1, 2 …. Where all are numbered as they stand, which is how it is in a cloud without
// duplicates, nothing is stored.
class Numbering {
public:
    Numbering() = default;
    explicit Numbering(std::vector<Index> numbers) : numbers_(std::move(numbers)), size_(numbers_.size()) {}

    static Numbering as_they_stand(std::size_t size) {
        Numbering result;
        result.size_ = size;
        return result;
    }

    std::size_t size() const { return size_; }
    Index operator[](std::size_t i) const { return numbers_.empty() ? static_cast<Index>(i) : numbers_[i]; }
    bool operator==(const Numbering&) const = default;

private:
    std::vector<Index> numbers_;
    std::size_t size_ = 0;
};

// The cube that the curve runs through: around all finite points.
struct MortonCube {
    Vec3d lowest = Vec3d::Zero();
    double edge = 1;
};

struct PointOrder {
    std::vector<Index>
        file_index;   // of each ordered point; points with a coordinate that is not finite are left out
    Numbering vertex; // of each ordered point, ascending
    Numbering
        first_point; // of each vertex: its first ordered point, that of the lowest file index; and the end
    MortonCube cube; // along whose curve they come

    std::size_t points() const { return file_index.size(); }
    std::size_t vertices() const { return first_point.size() > 0 ? first_point.size() - 1 : 0; }
};

// `positions`: 3 floats a point.
MortonCube morton_cube(std::span<const float> positions);

// Where a position in the cube, or the nearest one in it, stands on the curve: 21 bits an axis.
std::uint64_t morton_code(const Vec3d& position, const MortonCube& cube);

// `positions`: 3n floats in the order of the file. The order depends on the positions alone; ties go by
// coordinates, then by file index.
PointOrder order_points(std::span<const float> positions, Workers& workers, Progress& progress);

// Values of the points in the order of the file (`width` floats a point) in the order of computation, and
// back. `scatter` leaves the values of points that the order leaves out as they are.
void gather(const PointOrder& order, std::span<const float> file_values, std::size_t width,
            std::span<float> ordered, Workers& workers);
void scatter(const PointOrder& order, std::span<const float> ordered, std::size_t width,
             std::span<float> file_values, Workers& workers);

// Each vertex's position: 3 floats a vertex, from 3 floats an ordered point.
std::vector<float> vertex_positions(const PointOrder& order, std::span<const float> ordered_positions,
                                    Workers& workers);

} // namespace knead
