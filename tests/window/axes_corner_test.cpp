// The axes in the corner of the view, and the sides that they lead to.

#include "app/axes_corner.h"
#include "window/panel.h"

namespace knead::test {

namespace {

class AxesCorner : public Panel {
protected:
    void SetUp() override {
        Panel::SetUp();
        state_.fonts = fonts_;
        state_.view = {0, 0, 400, 300};
        editor_.document = std::make_shared<DocumentView>();
        look_at_side(editor_.camera, Side::front);
    }
    void draw() override { draw_axes(ui_, *ImGui::GetBackgroundDrawList()); }

    std::optional<int> axis_beside_middle(float x, float y) {
        const Rectangle place = axes_place(ui_);
        return axis_at(ui_, {place.x + place.width / 2 + x, place.y + place.height / 2 + y});
    }

    Editor editor_{1};
    UiState state_;
    std::vector<Command> commands_;
    std::vector<Wish> wishes_;
    Ui ui_{editor_, state_, commands_, wishes_};
};

TEST_F(AxesCorner, AreWhereTheyAreDrawn) {
    frames(2);
    EXPECT_EQ(axis_beside_middle(30, 0), 0); // from the front x points to the right
    EXPECT_EQ(axis_beside_middle(0, -30), 2);
    EXPECT_EQ(axis_beside_middle(-30, 0), std::nullopt);
    EXPECT_EQ(axis_beside_middle(15, -15), std::nullopt);
    state_.display.axes = false;
    EXPECT_EQ(axis_beside_middle(30, 0), std::nullopt);
}

TEST_F(AxesCorner, LeadToTheSideThatFacesAlongThemAndThenToTheOther) {
    for (const UpAxis up : {UpAxis::z, UpAxis::y, UpAxis::minus_y}) {
        for (int axis = 0; axis < 3; ++axis) {
            Camera camera;
            set_up(camera, up);
            look_at_side(camera, Side::front);
            camera.orientation = glm::normalize(camera.orientation * glm::dquat(0.9, 0.3, 0.2, 0.1));
            glm::dvec3 along(0.0);
            along[axis] = 1;
            for (const double way : {1.0, -1.0, 1.0}) {
                look_at_side(camera, side_of_axis(camera, axis));
                EXPECT_NEAR(glm::dot(camera.orientation * glm::dvec3(0, 0, 1), along), way, 1e-12);
            }
        }
    }
}

} // namespace

} // namespace knead::test
