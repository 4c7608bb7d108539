#pragma once
// Handles as the document knows them, and where their poses send points.

#include "cloud/point_cloud.h"
#include "deform/sample_system.h"
#include "edit/session.h"
#include "graph/vertex_labels.h"
#include "view/transform.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace knead {

struct Handle {
    std::string name;
    HandleRole role = HandleRole::moving;
    std::shared_ptr<const std::vector<Index>> points; // in the file, ascending, each once; never empty
    bool free_rotation = false; // gives its points their positions only; how they turn is up to the cloud
    double falloff = 0;         // how far along the surface it pulls what is around it, the less the farther
    std::optional<std::uint32_t> color = {}; // 0xrrggbb, where the user chose one
    Index came = 0; // numbers handles as they came; one that is declared anew keeps its own, for lists that
                    // keep their order
};

// Whether it takes a handle's points away from where they were at rest. One that was reset does not, though
// its drags are recorded.
bool leaves_rest(const HandleMotion& motion);

// Whether two handles, or lists of them, hold the same points in the same way, whatever their names. (The
// same points are the same array: handles share theirs when they are copied.)
bool holds_the_same(const Handle& a, const Handle& b);
bool hold_the_same(const std::vector<Handle>& a, const std::vector<Handle>& b);

// What an act changed in a list of handles: one went, one came, or one went and another came.
struct HandleChange {
    struct Place {
        Index at = 0; // in the list
        Handle handle;
    };
    std::optional<Place> gone; // from its place before,
    std::optional<Place> come; // to its place then
};
// The list after the act of what it was before, and the other way round. Where memory runs out nothing has
// changed.
void apply(const HandleChange& change, std::vector<Handle>& handles);
void take_back(const HandleChange& change, std::vector<Handle>& handles);

// Puts a point behind ranges that name only points before it.
void append_point(std::vector<IndexRange>& ranges, std::uint64_t point);

// The points that a handle line means. `file_position(i)` is where point i lies now, in the file's
// coordinates; points that are not finite belong to no region. Throws Error (input) at `place` for an index
// beyond the cloud and for a handle without any finite point.
std::vector<Index> resolve_points(const HandleLine& line, const PointCloud& cloud,
                                  const std::function<Vec3d(std::size_t)>& file_position,
                                  const std::string& place);

// The motion p → pivot + R S (p - pivot) + translate about the cloud's origin. Of the two quaternions of the
// turn, the one of the hemisphere of `before` (the frame before; the identity at first), which keeps turns
// beyond 360°; at exactly 90° between them, as written.
HandleMotion motion_of(const HandlePose& pose, const Vec3d& pivot, const Vec3d& origin, const Quatd& before);

// The pose about `pivot` that motion_of() turns into this motion again (up to rounding): the way back, for
// poses that were put together from several drags. Throws Error (usage) if the motion mirrors or flattens,
// which no pose does.
HandlePose pose_of(const HandleMotion& motion, const Vec3d& pivot, const Vec3d& origin);

// `change` after `motion`. The rotation continues that of `motion`.
HandleMotion followed_by(const HandleMotion& motion, const Transform& change);

// Who holds each ordered point (or vertex): a place in `handles`, `outside` for what lies outside the region
// of interest, no_index for free ones. A point in several handles belongs to the one declared last; handles
// beat the region.
struct HandleLabels {
    std::vector<Index> point;
    std::vector<Index> vertex; // that of its points which was declared last; free only if all of them are
    Index outside = 0;         // = the number of places

    // Of each block of rows_in_block vertices: 0 only where all of them and of their points are free, ...
    std::vector<std::uint8_t> held;
    // ... and 1 where a label changed since whoever looks for changes set that to 0.
    std::vector<std::uint8_t> changed;

    VertexLabels of_vertices() const { return {vertex, held}; }
};
struct PointOrder;
class Workers;
// `handles`: as they are declared; at places where `points` is null there is none (edit/handle_slots.h).
// `labels`: none yet, or those of other handles of the same cloud; only what those held, or these hold, is
// looked at. Where no point's label changed, vertices keep theirs, whatever became of these since.
void label_points(const std::vector<Handle>& handles, const PointOrder& order, std::size_t file_points,
                  Workers& workers, HandleLabels& labels);

} // namespace knead
