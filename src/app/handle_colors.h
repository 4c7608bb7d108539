#pragma once
// How handles look, in the list as in the view: a colour each, a pattern and an icon by role.

#include "app/icons.h"
#include "edit/session.h"

#include <map>
#include <string>

namespace knead {

// Colours that the user chose, by the handle's name.
using ChosenColors = std::map<std::string, ImU32>;

// The handle's colour: the one chosen, or one by role and number.
ImU32 handle_color(const ChosenColors& chosen, const std::string& name, std::size_t number, HandleRole role);
Icon icon_of(HandleRole role);
const char* words_for(HandleRole role); // "moving"

} // namespace knead
