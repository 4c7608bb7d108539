#include "app/handle_colors.h"

#include "app/theme.h"

#include <array>

namespace knead {

namespace {

using palette::rgb;

// Moving handles are bright and far apart in hue, also for those who see red and green alike; orange is left
// to the selection. Fixed ones are quiet, like something that is put away.
constexpr std::array moving{rgb(0x4aa8ff), rgb(0x4fd6a5), rgb(0xd08bff),
                            rgb(0xff7aa2), rgb(0x5fe0f2), rgb(0xe6dc62)};
constexpr std::array fixed{rgb(0x8091b5), rgb(0x9aa5b1), rgb(0x7f8fa0), rgb(0x9c93b8)};
constexpr std::array region{rgb(0xa9bf63), rgb(0x7fb28a)};

} // namespace

ImU32 handle_color(const ChosenColors& chosen, const std::string& name, std::size_t number, HandleRole role) {
    if (const auto found = chosen.find(name); found != chosen.end()) return found->second;
    switch (role) {
    case HandleRole::moving:
        return moving[number % moving.size()];
    case HandleRole::fixed:
        return fixed[number % fixed.size()];
    default:
        return region[number % region.size()];
    }
}

Icon icon_of(HandleRole role) {
    switch (role) {
    case HandleRole::moving:
        return Icon::moving;
    case HandleRole::fixed:
        return Icon::fixed;
    default:
        return Icon::region;
    }
}

const char* words_for(HandleRole role) {
    switch (role) {
    case HandleRole::moving:
        return "moving";
    case HandleRole::fixed:
        return "fixed";
    default:
        return "region of interest";
    }
}

} // namespace knead
