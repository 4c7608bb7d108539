#pragma once
// The settings of a header, a `set` line or --set, from JSON. Private to this room.

#include "edit/session.h"
#include "edit/session_values.h"

namespace knead::session_json {

// The settings among the keys of `object`, each checked for type and range; what this version of knead does
// not have yet is refused by name. Other keys than `besides` are refused, too.
SettingsChange settings_change(const Value& object, std::initializer_list<std::string_view> besides = {});

} // namespace knead::session_json
