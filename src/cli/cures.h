#pragma once
// What helps against an error, for whoever sits at the command line.

#include "base/error.h"

namespace knead {

// What to say behind an error's own words; "" where these say it.
inline const char* advice_for(Cure cure) {
    switch (cure) {
    case Cure::give_cloud:
        return "; say with --cloud which file to use";
    case Cure::open_session:
        return "; `knead replay` runs it";
    case Cure::told:
        break;
    }
    return "";
}

} // namespace knead
