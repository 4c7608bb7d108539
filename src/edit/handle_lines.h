#pragma once
// Handles as lines of a session, and the lines that change one.

#include "edit/handles.h"
#include "edit/select_mode.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

// What of a handle becomes another; what is not here stays as it is.
struct HandleEdit {
    std::string handle;
    std::optional<HandleRole> role = {}; // a region holds nothing: its rotation and falloff go
    struct Hold {
        bool free_rotation = false;
        double falloff = 0;
    };
    std::optional<Hold> hold = {}; // nothing for a region
    struct Color {
        std::optional<std::uint32_t> rgb; // none: the usual one
    };
    std::optional<Color> color = {};
    struct Pivot {
        std::optional<Vec3d> at_rest; // in the file's coordinates; none: the middle
    };
    std::optional<Pivot> pivot = {};
    struct Points {
        SelectMode mode = SelectMode::replace;
        std::vector<IndexRange> chosen; // ascending
    };
    std::optional<Points> points = {}; // nothing where none would be left
};

std::vector<IndexRange> ranges_of(const std::vector<Index>& points);

// As the session file declares it.
HandleLine line_of(const Handle& handle);

// Whether it is among these handles and is not so already.
bool changes(std::span<const Handle> handles, const HandleEdit& edit);

// The lines that change it; none where there is nothing to change.
//
// A handle is changed by declaring it anew, which makes it the last one; and what several hold follows the
// last of them. So that it robs nobody, all handles that came after it are declared again behind it, if one
// of them shares points with it. Where the edit gives it points it is meant to rob: then it alone is declared
// again, and of what it had declared before, it leaves out what others have. Another colour or pivot alone
// makes no handle another one: it keeps its place.
std::vector<SessionAction> lines_for(std::span<const Handle> handles, const HandleEdit& edit);

// What a line does to these handles, in a few words: makes one, or gives one that is there another pivot or
// colour, or something else. Empty where it leaves the handle what it is, which then only comes later.
std::string words_about(const HandleLine& line, std::span<const Handle> handles);

} // namespace knead
