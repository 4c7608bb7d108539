#pragma once
// Handles as the document knows them, and the lists that they stand in.

#include "cloud/point_cloud.h"
#include "edit/session.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
    std::optional<Vec3d> pivot = {}; // HandleLine::pivot, as it is on the rest shape of this edit
};

// Where the handle of this name stands in a list; nothing: there is none.
std::optional<std::size_t> number_of(std::span<const Handle> handles, std::string_view name);
// It, in the list; null: there is none.
const Handle* handle_named(std::span<const Handle> handles, std::string_view name);

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

} // namespace knead
