#pragma once
// What the tests of the tools share: a hand before a cloud that does what it is told.

#include "edit/tools.h"

#include "view/viewing.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace knead::test {

using Doing = Tools::Doing;

inline constexpr Modifiers plain{};
inline constexpr Modifiers shift{true, false, false};
inline constexpr Modifiers ctrl{false, true, false};
inline constexpr Modifiers alt{false, false, true};
inline constexpr glm::dvec2 middle{400, 300};

// The camera obeys.
struct Bench {
    Tools tools;
    ToolContext context;
    std::vector<Command> commands;

    Bench() {
        context.camera = camera_from(Side::front);
        context.viewport = screen;
    }
    void add_gizmo(const glm::dvec3& center = {0, 0, 0}) {
        context.gizmo.emplace();
        context.gizmo->center = center;
    }
    bool take(const Input& input) {
        const std::size_t before = commands.size();
        const bool used = handle_input(tools, context, input, commands);
        for (std::size_t i = before; i < commands.size(); ++i)
            if (const auto* move = std::get_if<MoveCamera>(&commands[i])) context.camera = move->camera;
        return used;
    }
    bool move(glm::dvec2 to, Modifiers held = {}) { return take(MouseMove{to, held}); }
    bool press(glm::dvec2 at, Modifiers held = {}, MouseButton button = MouseButton::left, int clicks = 1) {
        return take(MousePress{button, at, held, clicks});
    }
    bool release(glm::dvec2 at, Modifiers held = {}, MouseButton button = MouseButton::left) {
        return take(MouseRelease{button, at, held});
    }
    void drag(const std::vector<glm::dvec2>& path, Modifiers held = {},
              MouseButton button = MouseButton::left) {
        press(path.front(), held, button);
        for (const glm::dvec2& p : path) move(p, held);
        release(path.back(), held, button);
    }
    void click(glm::dvec2 at, Modifiers held = {}, int clicks = 1) {
        press(at, held, MouseButton::left, clicks);
        release(at, held);
    }
    bool hit(char letter, Modifiers held = {}) { return take(KeyPress{key(letter), held, false}); }
    bool hit(Key which, Modifiers held = {}) { return take(KeyPress{which, held, false}); }
    // As a window does: the key, then the character.
    void type(std::string_view text) {
        for (const char c : text) {
            hit(c);
            take(Character{static_cast<char32_t>(c)});
        }
    }
    template<typename T>
    std::vector<T> all() const {
        std::vector<T> some;
        for (const Command& command : commands)
            if (const auto* one = std::get_if<T>(&command)) some.push_back(*one);
        return some;
    }
    template<typename T>
    T only() const {
        EXPECT_EQ(all<T>().size(), 1U);
        return all<T>().empty() ? T{} : all<T>().front();
    }
    Transform last() const {
        EXPECT_FALSE(all<DragTo>().empty());
        return all<DragTo>().empty() ? Transform{} : all<DragTo>().back().transform;
    }
    double pixel() const { return pixel_size_at(context.camera, screen, {0, 0, 0}); }
};

template<typename T>
bool is(const Command& command) {
    return std::holds_alternative<T>(command);
}

} // namespace knead::test
