#pragma once
// How handles look, in the list as in the view: a colour each, a pattern and an icon by role.

#include "app/icons.h"
#include "edit/handles.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

// By the handles' names. A handle keeps its usual colour when others come and go, when it is renamed, and
// when it comes back by undo. One that the user chose is the handle's own.
struct HandleColors {
    struct Tried {
        std::string handle;
        ImU32 color = 0;
    };
    std::optional<Tried> tried; // in the picker, whose hand has not let go of it yet
    struct Place {
        std::size_t number = 0; // in the row of usual colours of its role
        std::weak_ptr<const std::vector<Index>> points;
    };
    std::map<std::string, Place> places; // of handles that are there or were
};

// Gives the new ones of these handles places, and those that were renamed what they had. "handle 3" gets the
// third colour of its role, so that it has the same one when its session is opened again; where another of
// that role has it, or the name has no number, the first that none has.
void place_colors(HandleColors& colors, std::span<const Handle> handles);

// The handles in the order in which they came: one that is changed, and so declared anew, stays where it is.
std::vector<std::size_t> order_of_list(std::span<const Handle> handles);

// The handle's colour: the one tried, the one chosen, or one by its role and place.
ImU32 handle_color(const HandleColors& colors, const Handle& handle);
Icon icon_of(HandleRole role);
const char* words_for(HandleRole role); // "moving"

} // namespace knead
