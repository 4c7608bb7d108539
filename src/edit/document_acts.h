#pragma once
// The lines of a session as acts on a document.

#include "edit/document.h"

#include <string>

namespace knead {

// Does what a line says. A check is nothing to a document: who replays looks after it. `place` names the line
// in errors, which are those of Document's acts.
void carry_out_act(Document& document, const SessionAction& action, const std::string& place,
                   Progress& progress);

} // namespace knead
