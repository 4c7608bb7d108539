#include "app/handle_colors.h"

#include "app/theme.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <set>

namespace knead {

namespace {

using palette::rgb;

// Moving handles are bright and far apart in hue, also for those who see red and green alike; orange is left
// to the selection. Fixed ones are quiet, like something that is put away.
constexpr std::array moving{rgb(0x4aa8ff), rgb(0x4fd6a5), rgb(0xd08bff),
                            rgb(0xff7aa2), rgb(0x5fe0f2), rgb(0xe6dc62)};
constexpr std::array fixed{rgb(0x8091b5), rgb(0x9aa5b1), rgb(0x7f8fa0), rgb(0x9c93b8)};
constexpr std::array region{rgb(0xa9bf63), rgb(0x7fb28a)};

// A renamed handle is a new name for the same points.
void take_over_place(HandleColors& colors, const Handle& handle) {
    const auto has_its_points = [&](const auto& entry) {
        return entry.second.points.lock() == handle.points;
    };
    const auto old = std::ranges::find_if(colors.places, has_its_points);
    if (old == colors.places.end()) return;
    colors.places[handle.name] = old->second;
    colors.places.erase(old);
}

// The number at the end of a name, from 0; nothing where it has none.
std::optional<std::size_t> number_in(const std::string& name) {
    std::size_t begin = name.size();
    while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
    std::size_t number = 0;
    const auto [end, trouble] = std::from_chars(name.data() + begin, name.data() + name.size(), number);
    if (trouble != std::errc{} || number == 0) return std::nullopt;
    return number - 1;
}

std::size_t free_number(const HandleColors& colors, std::span<const Handle> handles, const Handle& of) {
    std::set<std::size_t> taken;
    for (const Handle& handle : handles)
        if (const auto place = colors.places.find(handle.name);
            handle.role == of.role && place != colors.places.end())
            taken.insert(place->second.number);
    if (const auto wanted = number_in(of.name); wanted && !taken.contains(*wanted)) return *wanted;
    std::size_t number = 0;
    while (taken.contains(number)) ++number;
    return number;
}

} // namespace

void place_colors(HandleColors& colors, std::span<const Handle> handles) {
    for (const std::size_t number : order_of_list(handles)) {
        const Handle& handle = handles[number];
        if (!colors.places.contains(handle.name)) take_over_place(colors, handle);
        if (!colors.places.contains(handle.name))
            colors.places[handle.name] = {free_number(colors, handles, handle), {}};
        colors.places[handle.name].points = handle.points;
    }
}

std::vector<std::size_t> order_of_list(std::span<const Handle> handles) {
    std::vector<std::size_t> order(handles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t handle) { return handles[handle].came; });
    return order;
}

ImU32 handle_color(const HandleColors& colors, const Handle& handle) {
    if (colors.tried && colors.tried->handle == handle.name) return colors.tried->color;
    if (handle.color) return rgb(*handle.color);
    const auto place = colors.places.find(handle.name);
    const std::size_t number = place == colors.places.end() ? 0 : place->second.number;
    switch (handle.role) {
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
