#pragma once
// An editor with a bar in it, worked by commands and keys.

#include "edit/editor.h"
#include "edit/live.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace knead::test {

// An editor with the bar, seen from the front: z upwards, the ends at the top and at the bottom.
class BarEditor : public ::testing::Test {
protected:
    void SetUp() override {
        editor_.viewport = {800, 800};
        editor_.tools.select = SelectTool::box;
        OpenRequest request;
        request.file = bar_file(folder_);
        request.device = "reference";
        request.threads = 1;
        open(editor_, request);
        ASSERT_TRUE(wait_until([&] { return refresh(editor_) && editor_.document; }));
        calm();
        apply(editor_, LookAtSide{Side::front});
        apply(editor_, FrameView{});
    }

    void calm() {
        wait_until_idle(*editor_.live);
        refresh(editor_);
        refresh(editor_);
    }

    glm::dvec2 pixel_of(const glm::dvec3& point) {
        return project(editor_.camera, editor_.viewport, point)->pixel;
    }

    // Everything between two heights, through the bar.
    void select_heights(double low, double high, SelectMode mode = SelectMode::replace) {
        const ScreenBox box{{0, pixel_of({0, 0, high}).y}, {800, pixel_of({0, 0, low}).y}};
        apply(editor_, SelectRegion{box, mode, true});
    }

    std::size_t points_between(double low, double high) {
        const LineArray<float>& positions = editor_.frame.positions();
        std::size_t count = 0;
        for (std::size_t i = 2; i < positions.size(); i += 3)
            count += positions[i] >= static_cast<float>(low) && positions[i] <= static_cast<float>(high);
        return count;
    }

    void make_handles() {
        editor_.camera.orthographic = true;
        select_heights(-3, -2);
        apply(editor_, MakeHandle{HandleRole::fixed, "low"});
        select_heights(2, 3);
        apply(editor_, MakeHandle{HandleRole::moving, "high"});
        calm();
    }

    // The chosen handle by a typed amount, along or about an axis, and confirmed: 'R', 'X', "90".
    void transform_chosen(char kind, char axis, std::string_view amount) {
        move({400, 100});
        press(kind);
        press(axis);
        type(amount);
        press(Key::enter);
        calm();
    }
    // By so many degrees about the view's axis.
    void turn_chosen(std::string_view degrees) {
        move({400, 100});
        press('R');
        type(degrees);
        press(Key::enter);
        calm();
    }

    void press(char letter, Modifiers held = {}) { handle_input(editor_, KeyPress{key(letter), held}); }
    void press(Key which) { handle_input(editor_, KeyPress{which, {}}); }
    void move(glm::dvec2 cursor) { handle_input(editor_, MouseMove{cursor, {}}); }
    void type(std::string_view text) {
        for (const char c : text) {
            handle_input(editor_, KeyPress{key(c), {}});
            handle_input(editor_, Character{static_cast<char32_t>(c)});
        }
    }

    // The middle of the chosen handle's points in the shape as opened.
    glm::dvec3 middle_at_rest() {
        glm::dvec3 sum(0.0);
        for (const Index i : *chosen_handle(editor_)->points) {
            const float* p = editor_.opened.opened->positions.data() + 3 * std::size_t{editor_.ordered[i]};
            sum += glm::dvec3(p[0], p[1], p[2]);
        }
        return sum / static_cast<double>(chosen_handle(editor_)->points->size());
    }

    ScratchFolder folder_;
    Editor editor_{1};
};

} // namespace knead::test
